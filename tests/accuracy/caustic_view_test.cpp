// SPDX-License-Identifier: MIT
// Caustics as the eye sees them through and in specular surfaces, by photon mapping, against closed
// forms: Fresnel, T/n², absorption along the bent path, mirrors, a medium.
#include <cmath>
#include <numbers>

#include "framework/reference/eye.h"
#include "framework/reference/photon_mapping.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAlbedo = 0.6;

class CausticView : public testing::Test {
  protected:
    CausticView() {
        scene_.camera.verticalFovDegrees = 20.0;
        scene::Light sun;
        sun.power = glm::vec3(1000.0f);
        scene_.lights.push_back(sun);
        settings_.width = 16;
        settings_.height = 12;
        settings_.photonsPerBatch = 1u << 15;
        settings_.followsView = true;
    }
    static scene::Material matt() {
        scene::Material material;
        material.albedo = glm::vec3(static_cast<float>(kAlbedo));
        return material;
    }
    // Every pixel against `expected(direction)`, the closed form for an eye ray, which is even
    // enough over a pixel for its middle to be its mean.
    template <class Expected>
    void expectView(double largestError, const Expected& expected) {
        const EmbreeScene embree(scene_);
        PixelSums sums = makePhotonMappingSums(embree, settings_);
        RunOptions options;
        options.stop.batches = 64;
        photonMapping(embree, settings_, options, sums);
        const int layer = viewedCausticsLayer(scene_, settings_);
        ASSERT_EQ(layer, 2);
        const Eye eye(embree, settings_.width, settings_.height);
        double total = 0.0;
        double closed = 0.0;
        double variance = 0.0;
        for (int row = 0; row < settings_.height; ++row) {
            for (int column = 0; column < settings_.width; ++column) {
                const auto value = static_cast<std::size_t>(
                    3 * ((layer * settings_.height + row) * settings_.width + column) + 1);
                const double wanted = expected(glm::normalize(eye.ray(column + 0.5, row + 0.5)));
                const double error = sums.standardError(value);
                // 192 pixels and 64 batches: 5.5 errors are exceeded once in 1e4 runs.
                EXPECT_LT(std::abs(sums.mean(value) - wanted), 5.5 * error) << column << " " << row;
                EXPECT_LT(error, largestError * wanted);
                total += sums.mean(value);
                closed += wanted;
                variance += error * error;
            }
        }
        // The middles of pixels are their means to 1e-3.
        EXPECT_NEAR(total, closed, 5.0 * std::sqrt(variance) + 1e-3 * closed);
        EXPECT_LT(5.0 * std::sqrt(variance), 0.02 * closed);
    }

    scene::Scene scene_;
    PhotonMappingSettings settings_;
};

TEST_F(CausticView, LooksIntoWaterWithItsRadianceOverTheSquareOfTheIndex) {
    const double index = 1.333;
    const double depth = 0.5;
    const double absorption = 0.4;
    scene::Material water = glass(index);
    water.absorptionPerMeter = glm::vec3(static_cast<float>(absorption));
    addObject(scene_, scene::makePlane({{4.0, 4.0}, {1, 1}}), water);
    addObject(scene_, scene::makePlane({{6.0, 6.0}, {1, 1}}), matt(), {0.0, -depth, 0.0});
    scene_.camera.position = {0.0, 1.5, 2.2};
    scene_.camera.target = {0.0, 0.0, 0.0};
    const double entering = 1.0 - std::pow((index - 1.0) / (index + 1.0), 2);
    const double irradiance = 1000.0 * entering * std::exp(-absorption * depth);
    expectView(0.15, [&](const glm::dvec3& ray) {
        const double cosI = -ray.y;
        const double cosT = std::sqrt(1.0 - (1.0 - cosI * cosI) / (index * index));
        const double s = (cosI - index * cosT) / (cosI + index * cosT);
        const double p = (index * cosI - cosT) / (index * cosI + cosT);
        const double leaving = 1.0 - 0.5 * (s * s + p * p);
        return irradiance * kAlbedo / kPi * leaving / (index * index) *
               std::exp(-absorption * depth / cosT);
    });
}

// Light falls through a pane that bends nothing onto a floor, and the eye sees the floor in a
// mirror, all of it in a medium that absorbs.
TEST_F(CausticView, LooksIntoAMirrorThroughAMedium) {
    const double extinction = 0.1;
    scene::Material silver = mirror();
    silver.albedo = glm::vec3(0.8f);
    addObject(scene_, scene::makePlane({{6.0, 6.0}, {1, 1}}), glass(1.0), {0.0, 1.0, 0.0});
    addObject(scene_, scene::makePlane({{6.0, 6.0}, {1, 1}}), matt());
    addObject(scene_, scene::makePlane({{3.0, 3.0}, {1, 1}}), silver);
    // Upright at z = -1, its outside towards +z.
    scene_.objects[2].toWorld = glm::dmat4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0.0, -1.0, 1);
    scene_.medium = scene::Medium{glm::vec3(0.0f), glm::vec3(static_cast<float>(extinction)), 0.0f};
    scene_.camera.position = {0.0, 0.6, 0.6};
    scene_.camera.target = {0.0, 0.2, -1.0};
    scene_.camera.verticalFovDegrees = 10.0;
    // Pixels are small on the floor, and nothing varies within these radii.
    settings_.initialRadiusPixels = 2.0;
    settings_.photonsPerBatch = 1u << 18;
    const double irradiance = 1000.0 * std::exp(-extinction * 1.0);
    expectView(0.15, [&](const glm::dvec3& ray) {
        // The mirror image of the floor lies in the floor's plane.
        const double length = -0.6 / ray.y;
        return irradiance * kAlbedo / kPi * 0.8 * std::exp(-extinction * length);
    });
}

}  // namespace
}  // namespace kaustik::reference
