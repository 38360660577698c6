// SPDX-License-Identifier: MIT
// The two estimators share a photon's way through specular surfaces and nothing after it: one
// projects photons and divides by areas, the other casts eye rays and counts photons in a radius.
// Where they agree, camera, visibility, areas and normalisation are right.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framework/reference/light_tracing.h"
#include "framework/reference/photon_mapping.h"
#include "framework/scene/scene_file.h"

namespace kaustik::reference {
namespace {

constexpr int kWidth = 48;
constexpr int kHeight = 36;
constexpr std::uint64_t kBatches = 64;
// The share of 0.01 for a false alarm anywhere in 1728 pixels is 5.8e-6 for one, two-sided: 4.53
// normal errors, or 4.94 of Student's with some 63 degrees of freedom, as each side has 64 batches.
constexpr double kLargestDeviation = 4.94;

constexpr double kLargestRelativeError = 0.25;

class Agreement : public testing::TestWithParam<const char*> {};

TEST_P(Agreement, EstimatorsAgreeInAtLeast9975OfTenThousandPixels) {
    scene::Scene scene = scene::loadScene(GetParam());
    if (scene.name == "glass-sphere") {
        // The caustic alone: the ball's reflection spreads so thin that few photons reach a pixel.
        scene.camera.target = {0.55, 0.0, -0.21};
        scene.camera.verticalFovDegrees = 11.0;
    }
    const EmbreeScene embree(scene);
    const bool isDim = scene.name == "glass-sphere";
    RunOptions options;
    options.stop.batches = kBatches;
    LightTraceSettings light;
    light.width = kWidth;
    light.height = kHeight;
    light.photonsPerBatch = 1u << 15;
    PixelSums traced = makeLightTraceSums(embree, light);
    lightTrace(embree, light, options, traced);
    PhotonMappingSettings mapping;
    mapping.width = kWidth;
    mapping.height = kHeight;
    mapping.photonsPerBatch = isDim ? 1u << 16 : 1u << 15;
    mapping.seed = 2;  // independent photons
    mapping.initialRadiusPixels = isDim ? 1.0 : 0.5;
    PixelSums mapped = makePhotonMappingSums(embree, mapping);
    photonMapping(embree, mapping, options, mapped);

    std::size_t lit = 0;
    std::size_t tested = 0;
    std::size_t agreeing = 0;
    double sumTested = 0.0;
    double sumTraced = 0.0;
    double sumMapped = 0.0;
    double variance = 0.0;
    for (std::size_t pixel = 0; pixel < std::size_t{kWidth} * kHeight; ++pixel) {
        const std::size_t green = 3 * pixel + 1;
        const double a = traced.mean(green);
        const double b = mapped.mean(green);
        if (a == 0.0 && b == 0.0) continue;
        const double error = std::hypot(traced.standardError(green), mapped.standardError(green));
        ++lit;
        sumTraced += a;
        sumMapped += b;
        variance += error * error;
        // Where few of a pixel's points or photons count, errors are not normal and not known: a
        // pixel that surfaces cover in part, or that hardly any light reaches.
        const bool isKnown = error <= kLargestRelativeError * a &&
                             mapped.standardError(green) <= kLargestRelativeError * b && b > 0.0;
        if (!isKnown) continue;
        ++tested;
        sumTested += a;
        agreeing += std::abs(a - b) <= kLargestDeviation * error ? 1 : 0;
    }
    const double share = static_cast<double>(agreeing) / static_cast<double>(tested);
    RecordProperty("agreeing_per_mille", std::to_string(1000.0 * share));
    RecordProperty("pixels_lit", std::to_string(lit));
    RecordProperty("pixels_tested", std::to_string(tested));
    RecordProperty("energy_tested_per_mille", std::to_string(1000.0 * sumTested / sumTraced));
    EXPECT_GE(share, 0.9975) << agreeing << " of " << tested;
    // What is left out is dim, but for the tip of a focus that lies within one or two pixels.
    ASSERT_GT(tested, 200u);
    EXPECT_GT(sumTested, (isDim ? 0.7 : 0.95) * sumTraced);
    // The whole picture, with all that was left out; 0.2 % for what the radius loses at the edges
    // of surfaces.
    EXPECT_NEAR(sumMapped, sumTraced, 5.0 * std::sqrt(variance) + 2e-3 * sumTraced);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement,
                         testing::Values("flat-water", "glass-sphere", "pool", "ring"),
                         [](const auto& parameter) {
                             std::string name = parameter.param;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace kaustik::reference
