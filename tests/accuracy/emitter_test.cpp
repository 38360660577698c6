// SPDX-License-Identifier: MIT
// Lights that have a size, against closed forms: how much of them reaches a surface, and how soft
// the border of their light is.
#include <array>
#include <cmath>
#include <numbers>

#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "framework/scene/emitters.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

constexpr double kPi = std::numbers::pi;

scene::Material lamp(float radiance) {
    scene::Material material;
    material.albedo = glm::vec3(0.0f);
    material.emission = glm::vec3(radiance);
    return material;
}

double emittedWatts(const scene::Scene& scene) {
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = settings.height = 2;
    settings.photonsPerBatch = 1u << 17;
    PixelSums sums = makeLightTraceSums(embree, settings);
    RunOptions options;
    options.stop.batches = 4;
    lightTrace(embree, settings, options, sums);
    return sums.energy().watts[transport::kAccountEmitted];
}

// Between two squares of side 1 that face each other at that distance (Hottel's formula).
constexpr double kViewFactor = 0.199825;

TEST(Emitters, ASquareSendsItsViewFactorToAnother) {
    scene::Scene scene = sceneOf(scene::makePlane({{1.0, 1.0}, {1, 1}}), glass(1.5));
    addObject(scene, scene::makePlane({{1.0, 1.0}, {3, 5}}), lamp(2.0f), {0.0, 1.0, 0.0});
    scene.objects.back().toWorld[1] = {0.0, -1.0, 0.0, 0.0};  // it faces down
    scene.objects.back().toWorld[2] = {0.0, 0.0, -1.0, 0.0};
    scene::findEmitters(scene);
    ASSERT_EQ(scene.emitters.size(), 1u);
    // Half a million photons over a cone of which a tenth hits the pane: 0.4 % is two deviations.
    EXPECT_NEAR(emittedWatts(scene), 2.0 * kPi * kViewFactor, 0.004 * 2.0 * kPi * kViewFactor);
}

TEST(Emitters, ABallSendsAsMuchAsAPointFromAfar) {
    scene::Scene scene = sceneOf(scene::makePlane({{1.0, 1.0}, {1, 1}}), glass(1.5));
    constexpr double kRadius = 0.2;
    addObject(scene, scene::makeSphere({kRadius, 64}), lamp(1.0f), {0.0, 3.0, 0.0});
    scene::findEmitters(scene);
    // Outside of a ball that shines evenly its light is as if it came from its middle. A pane seen
    // from the axis: solid angle 4 asin(sin a sin b), with the half-angles of its sides.
    const double half = std::atan(0.5 / 3.0);
    const double solidAngle = 4.0 * std::asin(std::sin(half) * std::sin(half));
    const double intensity = kPi * kRadius * kRadius;
    // The ball of 64 sides has 0.3 % less area than a round one.
    EXPECT_NEAR(emittedWatts(scene), intensity * solidAngle, 0.01 * intensity * solidAngle);
}

TEST(Emitters, ADiscBringsWhatFacesItItsIrradiance) {
    scene::Scene scene = sceneOf(scene::makePlane({{3.0, 2.0}, {1, 1}}), glass(1.5));
    scene.lights.push_back({});
    scene.lights[0].power = glm::vec3(7.0f);
    scene.lights[0].angularDiameterRadians = 0.3f;
    scene::findEmitters(scene);
    EXPECT_NEAR(emittedWatts(scene), 7.0 * 6.0, 0.002 * 42.0);
}

// π L on either side of a pane, whatever parts of the sky each number of points stands for.
TEST(Emitters, AnEvenSkyBringsAPanePiTimesItsRadianceOnEitherSide) {
    scene::Scene scene = sceneOf(scene::makePlane({{3.0, 2.0}, {1, 1}}), glass(1.5));
    scene.backgroundRadiance = glm::vec3(0.5f);
    scene.environmentLights = true;
    scene::findEmitters(scene);
    ASSERT_EQ(scene.emitters.size(), 1u);
    const double expected = 2.0 * kPi * 0.5 * 6.0;
    // A quarter of half a million photons hits the pane.
    EXPECT_NEAR(emittedWatts(scene), expected, 0.01 * expected);
    scene::placeLightPoints(scene, 256, 600);
    glm::dvec3 upwards(0.0);
    double above = 0.0;
    for (const scene::Light& light : scene.lights) {
        upwards += glm::dvec3(light.direction) * static_cast<double>(light.power.g);
        above += std::max(-light.direction.y, 0.0) * static_cast<double>(light.power.g);
    }
    EXPECT_LT(glm::length(upwards), 0.02);
    EXPECT_NEAR(above, kPi * 0.5, 0.01 * kPi);
}

// Flux on the floor by the distance beyond the pane's edge.
struct EdgeProfile : NullSink {
    static constexpr std::size_t kBins = 12;
    double edge = 0.0;
    double reach = 0.0;  // of the penumbra, m
    double length = 0.0;
    glm::dvec3 center{0.0};
    std::array<double, kBins> watts{};

    void arrived(const SurfaceHit& hit, const PhotonState& photon) {
        const glm::dvec3 at = hit.position + center;
        const double bin = ((at.x - edge) / reach + 1.2) / 2.4 * kBins;
        if (std::abs(at.z) > 0.5 * length || !(bin >= 0.0 && bin < kBins)) return;
        watts[static_cast<std::size_t>(bin)] += photon.fluxWatts.x;
    }
};

// What a disc leaves of its light beyond an edge that goes across it.
double shareOfDisc(double distance) {
    if (distance <= -1.0) return 1.0;
    if (distance >= 1.0) return 0.0;
    return 0.5 - (std::asin(distance) + distance * std::sqrt(1.0 - distance * distance)) / kPi;
}

class Penumbra : public ::testing::Test {
  protected:
    static constexpr double kDepth = 2.0;
    static constexpr double kIndex = 1.333;
    static constexpr double kDiameter = 0.14;  // 8 degrees
    Penumbra() : scene(sceneOf(scene::makePlane({{2.0, 2.0}, {1, 1}}), glass(kIndex))) {
        addObject(scene, scene::makePlane({{4.0, 4.0}, {1, 1}}), scene::Material{},
                  {0.0, -kDepth, 0.0});
        scene.lights.push_back({});
        scene.lights[0].power = glm::vec3(1.0f);
        scene.lights[0].angularDiameterRadians = static_cast<float>(kDiameter);
        scene::findEmitters(scene);
    }
    // By how much the worst bin is off, as a part of the irradiance within.
    [[nodiscard]] double worst() const {
        const EmbreeScene embree(scene);
        const LightSampler sampler(embree, 6000000);
        const LightTransport transport(embree, {});
        EdgeProfile profile;
        profile.edge = 1.0;
        profile.reach = kDepth * std::tan(std::asin(std::sin(0.5 * kDiameter) / kIndex));
        profile.length = 1.0;
        profile.center = embree.center();
        for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
            Random random(1, 0, i);
            const EmittedPhoton emitted = sampler.sample(i, random);
            transport.follow(stateOf(emitted), emitted.reach, random, profile);
        }
        const double r = (kIndex - 1.0) / (kIndex + 1.0);
        const double within = 1.0 - r * r;
        const double width = 2.4 * profile.reach / EdgeProfile::kBins;
        double most = 0.0;
        for (std::size_t i = 0; i < EdgeProfile::kBins; ++i) {
            const double from = -1.2 + 2.4 * static_cast<double>(i) / EdgeProfile::kBins;
            double expected = 0.0;
            for (int k = 0; k < 32; ++k)
                expected += shareOfDisc(from + 2.4 / EdgeProfile::kBins * (k + 0.5) / 32) / 32;
            const double found = profile.watts[i] / (width * profile.length);
            most = std::max(most, std::abs(found - within * expected) / within);
        }
        return most;
    }
    scene::Scene scene;
};

// 6 million photons, some 15,000 in a bin that is wholly lit: 0.8 % of noise; three times that.
TEST_F(Penumbra, OfADiscBehindAPaneIsWhatTheClosedFormSays) {
    EXPECT_LT(worst(), 0.025);
}

// Steps of a 64th: a test of what stands for the disc on the device.
TEST_F(Penumbra, OfItsPointsComesNearAsTheyBecomeMore) {
    const auto withPoints = [&](int count) {
        const scene::Scene whole = scene;
        scene::placeLightPoints(scene, count, 600);
        scene.emitters.clear();
        for (scene::Light& light : scene.lights)
            light.emitter = -1;
        const double found = worst();
        scene = whole;
        return found;
    };
    EXPECT_GT(withPoints(1), 0.4);
    EXPECT_LT(withPoints(256), 0.04);
}

}  // namespace
}  // namespace kaustik::reference
