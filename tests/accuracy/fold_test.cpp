// SPDX-License-Identifier: MIT
// Near a fold the irradiance grows as one over the square root of the distance from it
// (framework/numerics/README.md, "Closed forms"): light through a wave A cos kx on a floor beyond
// its first focus.
#include <array>
#include <cmath>
#include <numbers>

#include "framework/reference/light_sampling.h"
#include "framework/scene/shapes/height_field.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

constexpr double kAmplitude = 0.01;
constexpr double kWavelength = 1.0;
constexpr double kWaveNumber = 2.0 * std::numbers::pi / kWavelength;
constexpr double kIndex = 1.333;
constexpr double kDepth = 15.0;  // the first focus is at 10.1 m

// Where light that hits the water at x arrives on the floor.
double arrival(double x) {
    const double height = kAmplitude * std::cos(kWaveNumber * x);
    const double slope = -kAmplitude * kWaveNumber * std::sin(kWaveNumber * x);
    const double incidence = std::atan(slope);
    const double refraction = std::asin(std::sin(incidence) / kIndex);
    // The normal leans to -slope; the ray turns from straight down towards +slope.
    return x + (kDepth + height) * std::tan(incidence - refraction);
}

// The fold of the crest at x = 0 that lies at negative x: the least arrival from its right side.
double foldPosition() {
    double minimum = 1.0;
    for (double x = 0.05; x < 0.25; x += 1e-5)
        minimum = std::min(minimum, arrival(x));
    return minimum;
}

constexpr std::size_t kBins = 8;
constexpr double kNearest = 2e-4;  // m, several cells of the mesh
constexpr double kFarthest = 6e-3;

// Flux in bins of the distance from either fold of the crest, inside and outside.
struct FoldHistogram : NullSink {
    double fold = 0.0;  // its distance from the axis
    double center = 0.0;
    std::array<double, kBins> inside{};
    std::array<double, kBins> outside{};

    void arrived(const SurfaceHit& hit, const PhotonState& photon) {
        const double distance = fold - std::abs(hit.position.x + center);
        const double ratio =
            std::log(std::abs(distance) / kNearest) / std::log(kFarthest / kNearest);
        const double bin = std::floor(ratio * static_cast<double>(kBins));
        if (!(bin >= 0.0 && bin < static_cast<double>(kBins))) return;
        (distance > 0.0 ? inside : outside)[static_cast<std::size_t>(bin)] += photon.fluxWatts.x;
    }
};

TEST(Fold, IrradianceGrowsAsTheInverseSquareRootOfTheDistance) {
    scene::HeightField field;
    field.sizeMeters = {2.0f, 0.2f};
    field.cells = {2048, 2};
    field.waves = {{static_cast<float>(kAmplitude), static_cast<float>(kWavelength), 0, 0, 0}};
    scene::Scene scene = sceneOf(scene::makeHeightField(field, 0.0), glass(kIndex));
    addObject(scene, scene::makePlane({{20.0, 20.0}, {1, 1}}), scene::Material{},
              {0.0, -kDepth, 0.0});
    scene.lights.push_back({});
    const EmbreeScene embree(scene);
    const LightSampler sampler(embree, 3000000);
    const LightTransport transport(embree, {});
    FoldHistogram histogram;
    histogram.fold = -foldPosition();
    histogram.center = embree.center().x;
    ASSERT_GT(histogram.fold, 0.03);
    for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
        Random random(1, 0, i);
        const EmittedPhoton emitted = sampler.sample(i, random);
        transport.follow(stateOf(emitted), emitted.reach, random, histogram);
    }
    // A line through log E over log d. The sheet that does not fold is what lies outside.
    double sumX = 0.0;
    double sumY = 0.0;
    double sumXX = 0.0;
    double sumXY = 0.0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        const auto edge = [](std::size_t i) {
            return kNearest * std::pow(kFarthest / kNearest, static_cast<double>(i) / kBins);
        };
        const double width = edge(bin + 1) - edge(bin);
        const double x = std::log(std::sqrt(edge(bin) * edge(bin + 1)));
        const double y = std::log((histogram.inside[bin] - histogram.outside[bin]) / width);
        sumX += x;
        sumY += y;
        sumXX += x * x;
        sumXY += x * y;
    }
    const double slope = (kBins * sumXY - sumX * sumY) / (kBins * sumXX - sumX * sumX);
    // Some 5,000 to 25,000 photons a bin are 1 % of noise, 0.005 in the slope; the next term of the
    // fold's expansion adds 3 % at the farthest bin, 0.01.
    EXPECT_NEAR(slope, -0.5, 0.02);
}

}  // namespace
}  // namespace kaustik::reference
