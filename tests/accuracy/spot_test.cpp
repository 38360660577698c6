// SPDX-License-Identifier: MIT
// The flux of spots against its closed form, and where their image's parts go.
#include <array>
#include <cmath>
#include <numbers>

#include "framework/image/image.h"
#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "tests/accuracy/path_fixture.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInner = 20.0 * kPi / 180.0;
constexpr double kOuter = 40.0 * kPi / 180.0;
constexpr double kIntensity = 50.0;
// Full in the inner cone, then a squared ramp in the cosine.
const double kFlux = kIntensity * 2.0 * kPi *
                     ((1.0 - std::cos(kInner)) + (std::cos(kInner) - std::cos(kOuter)) / 3.0);

// With one photon in each of N cells, some 0.5 sqrt(N) of them from axis to edge, the falloff
// changes by up to 2/(0.5 sqrt(N)) in a cell, the deviation of which is 0.29 of that: the mean of
// them all, near 0.5, is off by some 2/N of itself, 2e-5 for four batches of 2^16. Three times
// that; angles in 32 bits are 1e-7.
constexpr double kFalloffTolerance = 6e-5;

// A spot at 2 m, tilted, above a pane that holds its whole cone.
scene::Scene spotOverGlass() {
    scene::Scene scene = sceneOf(scene::makePlane({{40.0, 40.0}, {1, 1}}), glass(1.5));
    scene::Light spot;
    spot.kind = scene::LightKind::spot;
    spot.position = {0.0, 2.0, 0.0};
    spot.direction = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
    spot.up = glm::normalize(glm::cross(spot.direction, glm::dvec3(-1.0, 0.0, 0.3)));
    spot.innerConeRadians = static_cast<float>(kInner);
    spot.outerConeRadians = static_cast<float>(kOuter);
    spot.power = glm::vec3(static_cast<float>(kIntensity));
    scene.lights.push_back(spot);
    scene.camera.position = {0.0, 1.0, 3.0};
    return scene;
}

TEST(Spot, SendsOutTheClosedFormFluxOfItsCone) {
    const scene::Scene scene = spotOverGlass();
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = settings.height = 2;
    settings.photonsPerBatch = 1u << 16;
    PixelSums sums = makeLightTraceSums(embree, settings);
    RunOptions options;
    options.stop.batches = 4;
    lightTrace(embree, settings, options, sums);
    EXPECT_NEAR(sums.energy().watts[transport::kAccountEmitted], kFlux, kFalloffTolerance * kFlux);
}

class TexturedSpot : public testing::Test {
  protected:
    // An image of 64 by 64 whose quarters have these colours, clockwise from the upper left.
    void project(const std::array<glm::vec3, 4>& quarters) {
        Image image(64, 64, 3);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const std::size_t quarter = y < 32 ? (x < 32 ? 0 : 1) : (x < 32 ? 3 : 2);
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) = quarters[quarter][c];
            }
        }
        writeImage(folder_ / "slide.pfm", image);
        scene_.images.push_back({"slide", folder_ / "slide.pfm", "", false});
        scene_.lights[0].image = 0;
        const EmbreeScene embree(scene_);
        const LightSampler sampler(embree, kPhotons);
        const scene::Light& light = scene_.lights[0];
        // As someone behind the light sees it.
        const glm::dvec3 right = glm::cross(light.direction, light.up);
        for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
            Random random(1, 0, i);
            const EmittedPhoton photon = sampler.sample(i, random);
            const bool isRight = glm::dot(photon.direction, right) > 0.0;
            const bool isUpper = glm::dot(photon.direction, light.up) > 0.0;
            flux_[isUpper ? (isRight ? 1 : 0) : (isRight ? 2 : 3)] += photon.fluxWatts;
            total_ += photon.fluxWatts;
        }
    }
    static constexpr std::uint64_t kPhotons = 1u << 18;
    // Cells that an edge of the image cuts, 2 sqrt(N) of N, have half of their flux at random: a
    // relative error of sqrt(2 sqrt(N)) / 2N, 6e-5; 5 of it and as much again for the falloff.
    static constexpr double kTolerance = 6e-4;

    const test::TemporaryFolder folder_;
    scene::Scene scene_ = spotOverGlass();
    std::array<glm::dvec3, 4> flux_{};
    glm::dvec3 total_{0.0};
};

TEST_F(TexturedSpot, HalfBlackAndHalfWhiteSendsOutHalfOfTheFlux) {
    project({glm::vec3(0.0f), glm::vec3(1.0f), glm::vec3(1.0f), glm::vec3(0.0f)});
    // Between the halves the bilinear ramp is even about the middle.
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(total_[c], 0.5 * kFlux, kTolerance * kFlux);
    // The ramp reaches half a texel into the black: 1/256 of the width, at most 2/pi · 4/256 of the
    // flux of a half's disc … times 2 for the falloff, which gathers it in the middle.
    EXPECT_LT(flux_[0].x + flux_[3].x, 0.02 * kFlux);
}

TEST_F(TexturedSpot, EveryQuarterGoesWhereItsFrameSays) {
    project({glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 1, 1)});
    EXPECT_NEAR(total_.r, 0.5 * kFlux, kTolerance * kFlux);
    EXPECT_NEAR(total_.g, 0.5 * kFlux, kTolerance * kFlux);
    EXPECT_NEAR(total_.b, 0.5 * kFlux, kTolerance * kFlux);
    const double quarter = 0.25 * kFlux;
    const std::array<glm::dvec3, 4> expected = {glm::dvec3(quarter, 0, 0),
                                                glm::dvec3(0, quarter, 0),
                                                glm::dvec3(0, 0, quarter), glm::dvec3(quarter)};
    for (std::size_t i = 0; i < 4; ++i) {
        // What the ramps between the quarters take and give.
        EXPECT_LT(glm::length(flux_[i] - expected[i]), 0.06 * quarter) << i;
    }
}

TEST_F(TexturedSpot, ABrightImageCountsAsItIs) {
    project({glm::vec3(3.0f), glm::vec3(3.0f), glm::vec3(3.0f), glm::vec3(3.0f)});
    EXPECT_NEAR(total_.g, 3.0 * kFlux, kFalloffTolerance * 3.0 * kFlux);
}

}  // namespace
}  // namespace kaustik::reference
