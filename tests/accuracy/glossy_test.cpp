// SPDX-License-Identifier: MIT
// Caustic radiance towards the eye against closed forms: irradiance times the receiver's BRDF.
#include <cmath>
#include <numbers>

#include "framework/core/error.h"
#include "framework/image/image.h"
#include "framework/reference/eye.h"
#include "framework/reference/light_tracing.h"
#include "framework/reference/photon_mapping.h"
#include "framework/scene/texture.h"
#include "tests/accuracy/path_fixture.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reference {
namespace {

constexpr double kPi = std::numbers::pi;

PixelSums trace(const EmbreeScene& scene, const LightTraceSettings& settings,
                std::uint64_t batches) {
    PixelSums sums = makeLightTraceSums(scene, settings);
    RunOptions options;
    options.stop.batches = batches;
    lightTrace(scene, settings, options, sums);
    return sums;
}

// Every value of a layer against `expected(column, row, channel)`, and the mean of all far closer:
// 64 batches know the error to 9 %, and 5.5 errors are exceeded once in 1e4 runs of 600 values.
template <class Expected>
void expectLayer(const PixelSums& sums, int layer, double largestError, const Expected& expected) {
    double total = 0.0;
    double wanted = 0.0;
    double variance = 0.0;
    for (int row = 0; row < sums.height(); ++row) {
        for (int column = 0; column < sums.width(); ++column) {
            for (int channel = 0; channel < 3; ++channel) {
                const auto value = static_cast<std::size_t>(
                    3 * ((layer * sums.height() + row) * sums.width() + column) + channel);
                const double closed = expected(column, row, channel);
                const double error = sums.standardError(value);
                EXPECT_LT(std::abs(sums.mean(value) - closed), 5.5 * error)
                    << column << ", " << row << ", " << channel;
                EXPECT_LT(error, largestError * closed);
                total += sums.mean(value);
                wanted += closed;
                variance += error * error;
            }
        }
    }
    // Channels share their photons: their errors add up, not their squares. The rule over the
    // pixels is good to 1e-4.
    EXPECT_NEAR(total, wanted, 5.0 * std::sqrt(3.0 * variance) + 1e-4 * wanted);
    EXPECT_LT(5.0 * std::sqrt(3.0 * variance), 5e-3 * wanted);
}

// The mean over a pixel of what a point of the plane y = `height` has, by Simpson's rule on 2x2
// parts.
template <class Value>
double pixelMean(const Eye& eye, const EmbreeScene& scene, int column, int row, double height,
                 const Value& valueAt) {
    double sum = 0.0;
    for (int i = 0; i < 25; ++i) {
        const double weights[5] = {1.0, 4.0, 2.0, 4.0, 1.0};
        const glm::dvec3 ray = eye.ray(column + 0.25 * (i % 5), row + 0.25 * (i / 5));
        const glm::dvec3 origin = eye.position() + scene.center();
        const glm::dvec3 point = origin + ray * ((height - origin.y) / ray.y);
        sum += weights[i % 5] * weights[i / 5] / 144.0 * valueAt(point, -glm::normalize(ray));
    }
    return sum;
}

TEST(Glossy, BeamThroughASlabGivesTheFloorItsClosedFormRadiance) {
    const double index = 1.5;
    const double incidence = 40.0 * kPi / 180.0;
    scene::Material floor;
    floor.kind = scene::MaterialKind::glossy;
    floor.albedo = {0.5f, 0.2f, 0.0f};
    floor.specular = {0.1f, 0.25f, 0.4f};
    floor.exponent = 30.0f;
    scene::Scene scene = sceneOf(scene::makeBox({{8.0, 0.5, 8.0}, false, {}}), glass(index));
    scene.objects[0].toWorld[3].y = 1.0;
    addObject(scene, scene::makePlane({{20.0, 20.0}, {1, 1}}), floor);
    scene::Light sun;
    sun.direction = {std::sin(incidence), -std::cos(incidence), 0.0};
    sun.power = glm::vec3(1000.0f);
    scene.lights.push_back(sun);
    // Towards the mirror direction, so that the lobe and its flank are in the picture.
    scene.camera.position = {3.2, 3.2, 0.0};
    scene.camera.target = {0.0, 0.0, 0.0};
    scene.camera.verticalFovDegrees = 24.0;
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 16;
    settings.height = 12;
    settings.photonsPerBatch = 1u << 16;
    const PixelSums sums = trace(embree, settings, 64);
    ASSERT_EQ(causticRadianceLayer(scene), 1);
    ASSERT_EQ(sums.layers(), 2);

    // All orders of reflection between the two faces leave in parallel: (1-R)²/(1-R²).
    const double cosI = std::cos(incidence);
    const double cosT = std::sqrt(1.0 - std::pow(std::sin(incidence) / index, 2));
    const double s = (cosI - index * cosT) / (cosI + index * cosT);
    const double p = (index * cosI - cosT) / (index * cosI + cosT);
    const double reflectance = 0.5 * (s * s + p * p);
    const double irradiance = 1000.0 * cosI * (1.0 - reflectance) / (1.0 + reflectance);
    const Eye eye(embree, settings.width, settings.height);
    expectLayer(sums, kIrradianceLayer, 0.05, [&](int, int, int) { return irradiance; });
    expectLayer(sums, 1, 0.05, [&](int column, int row, int channel) {
        return pixelMean(
            eye, embree, column, row, 0.0, [&](const glm::dvec3&, const glm::dvec3& toEye) {
                const glm::dvec3 mirrored(std::sin(incidence), std::cos(incidence), 0.0);
                const double lobe =
                    32.0 / (2.0 * kPi) * std::pow(std::max(glm::dot(mirrored, toEye), 0.0), 30.0);
                return irradiance * (static_cast<double>(floor.albedo[channel]) / kPi +
                                     static_cast<double>(floor.specular[channel]) * lobe);
            });
    });
}

// Still water above a floor whose image has texels as large as a third of the picture.
TEST(Glossy, TexturedFloorHasIrradianceTimesAlbedoOverPi) {
    const test::TemporaryFolder folder;
    Image image(3, 2, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = 0.1f + 0.045f * static_cast<float>((7 * i) % 18);
    writeImage(folder / "floor.pfm", image);
    scene::Scene scene =
        sceneOf(scene::makePlane({{4.0, 4.0}, {1, 1}}), glass(1.333));  // water, one face
    scene::Material floor;
    floor.kind = scene::MaterialKind::glossy;  // its lobe is empty
    floor.albedo = {1.0f, 0.5f, 0.8f};
    floor.image = 0;
    floor.uvScale = {0.75f, 0.5f};  // repeats within the floor of 4 m by 4 m
    scene.images.push_back({"floor", folder / "floor.pfm", "", false});
    addObject(scene, scene::makePlane({{4.0, 4.0}, {1, 1}}), floor, {0.0, -1.0, 0.0});
    scene::Light sun;
    sun.power = glm::vec3(1000.0f);
    scene.lights.push_back(sun);
    scene.camera.position = {0.0, 2.0, 0.0};
    scene.camera.target = {0.0, -1.0, 0.0};
    scene.camera.up = {0.0, 0.0, -1.0};
    scene.camera.verticalFovDegrees = 50.0;
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 16;
    settings.height = 12;
    settings.photonsPerBatch = 1u << 14;
    const PixelSums sums = trace(embree, settings, 64);

    // The plane's uv at a corner, from the mesh itself; uv are metres.
    const scene::Mesh& mesh = scene.meshes[1];
    const auto uvAt = [&](const glm::dvec3& point) {
        const glm::dvec2 corner(mesh.positions[0].x, mesh.positions[0].z);
        const glm::dvec2 offset = glm::dvec2(point.x, point.z) - corner;
        glm::dvec2 uv(mesh.uvs[0]);
        for (std::size_t i = 1; i < mesh.positions.size(); ++i) {
            const glm::dvec2 side = glm::dvec2(mesh.positions[i].x, mesh.positions[i].z) - corner;
            if (side.x != 0.0 && side.y != 0.0) continue;  // the far corner
            const glm::dvec2 change = glm::dvec2(mesh.uvs[i]) - glm::dvec2(mesh.uvs[0]);
            uv += change * glm::dot(offset, side) / glm::dot(side, side);
        }
        return uv;
    };
    const auto albedoAt = [&](const glm::dvec3& point, int channel) {
        const glm::dvec2 p = uvAt(point) * glm::dvec2(0.75, 0.5);
        // Tents around the centres of all texels and their repeats.
        double sum = 0.0;
        for (int row = -4; row < 8; ++row) {
            for (int column = -6; column < 12; ++column) {
                const double x = p.x * 3.0 - (column + 0.5);
                const double y = (1.0 - p.y) * 2.0 - (row + 0.5);
                const double weight =
                    std::max(0.0, 1.0 - std::abs(x)) * std::max(0.0, 1.0 - std::abs(y));
                if (weight > 0.0)
                    sum += weight *
                           static_cast<double>(image.at((column + 6) % 3, (row + 4) % 2, channel));
            }
        }
        return sum * static_cast<double>(floor.albedo[channel]);
    };
    const double irradiance = 1000.0 * (1.0 - std::pow(0.333 / 2.333, 2));
    const Eye eye(embree, settings.width, settings.height);
    expectLayer(sums, 1, 0.05, [&](int column, int row, int channel) {
        return pixelMean(eye, embree, column, row, -1.0,
                         [&](const glm::dvec3& point, const glm::dvec3&) {
                             return irradiance * albedoAt(point, channel) / kPi;
                         });
    });
}

TEST(Glossy, OnlyScenesWithAGlossyReceiverHaveTheLayer) {
    scene::Scene scene = sceneOf(scene::makePlane({{4.0, 4.0}, {1, 1}}), glass(1.333));
    addObject(scene, scene::makePlane({{4.0, 4.0}, {1, 1}}), scene::Material{}, {0.0, -1.0, 0.0});
    EXPECT_EQ(causticRadianceLayer(scene), -1);
    EXPECT_EQ(makeLightTraceSums(EmbreeScene(scene), {}).layers(), 1);
    EXPECT_EQ(makePhotonMappingSums(EmbreeScene(scene), {}).layers(), 2);
    scene.materials[1].kind = scene::MaterialKind::glossy;
    scene.medium = scene::Medium{glm::vec3(0.1f), glm::vec3(0.0f), 0.0f};
    EXPECT_EQ(causticRadianceLayer(scene), 2);
    EXPECT_EQ(makeLightTraceSums(EmbreeScene(scene), {}).layers(), 3);
    EXPECT_EQ(makePhotonMappingSums(EmbreeScene(scene), {}).layers(), 3);
}

TEST(Glossy, EncodedImagesAreDecodedAndLinearOnesAreNot) {
    const test::TemporaryFolder folder;
    Image image(1, 1, 3);
    image.values = {0.5f, 0.02f, 1.0f};
    writeImage(folder / "x.pfm", image);
    const Image encoded = scene::decodeTexture({"x", folder / "x.pfm", "", true});
    EXPECT_NEAR(encoded.values[0], 0.21404114f, 1e-6f);
    EXPECT_NEAR(encoded.values[1], 0.02f / 12.92f, 1e-7f);
    EXPECT_EQ(encoded.values[2], 1.0f);
    EXPECT_EQ(scene::decodeTexture({"x", folder / "x.pfm", "", false}).values, image.values);
    image.values[1] = -0.1f;
    writeImage(folder / "x.pfm", image);
    EXPECT_THROW((void)scene::decodeTexture({"x", folder / "x.pfm", "", false}), IoError);
}

}  // namespace
}  // namespace kaustik::reference
