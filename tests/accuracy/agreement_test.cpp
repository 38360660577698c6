// SPDX-License-Identifier: MIT
// The two estimators share a photon's path through specular surfaces and nothing after it: one
// projects photons and divides by areas, the other casts eye rays and counts photons in a radius.
// Where they agree, camera, visibility, areas and normalisation are right.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framework/reference/light_tracing.h"
#include "framework/reference/photon_mapping.h"
#include "framework/scene/files/scene_file.h"

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

struct Comparison {
    std::size_t lit = 0;
    std::size_t tested = 0;
    std::size_t agreeing = 0;
    double sumTested = 0.0;
    double sumTraced = 0.0;
    double sumMapped = 0.0;
    double variance = 0.0;
};

// The green of a layer of either.
Comparison compare(const PixelSums& traced, int tracedLayer, const PixelSums& mapped,
                   int mappedLayer) {
    Comparison result;
    constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
        const auto valueOf = [&](int layer) {
            return 3 * (static_cast<std::size_t>(layer) * kPixels + pixel) + 1;
        };
        const double a = traced.mean(valueOf(tracedLayer));
        const double b = mapped.mean(valueOf(mappedLayer));
        if (a == 0.0 && b == 0.0) continue;
        const double mappedError = mapped.standardError(valueOf(mappedLayer));
        const double error = std::hypot(traced.standardError(valueOf(tracedLayer)), mappedError);
        ++result.lit;
        result.sumTraced += a;
        result.sumMapped += b;
        result.variance += error * error;
        // Where few of a pixel's points or photons count, errors are not normal and not known: a
        // pixel that surfaces cover in part, or that hardly any light reaches.
        const bool isKnown = error <= kLargestRelativeError * a &&
                             mappedError <= kLargestRelativeError * b && b > 0.0;
        if (!isKnown) continue;
        ++result.tested;
        result.sumTested += a;
        result.agreeing += std::abs(a - b) <= kLargestDeviation * error ? 1 : 0;
    }
    return result;
}

TEST_P(Agreement, EstimatorsAgreeInAtLeast9975OfTenThousandPixels) {
    scene::Scene scene = scene::loadScene(GetParam());
    if (scene.name == "glass-sphere") {
        // The caustic alone: the ball's reflection spreads so thin that few photons reach a pixel.
        scene.camera.target = {0.55, 0.0, -0.21};
        scene.camera.verticalFovDegrees = 11.0;
    }
    if (scene.name == "glossy-table") {
        // The caustic of the glass ring.
        scene.camera.target = {0.6, 0.0, 0.45};
        scene.camera.verticalFovDegrees = 14.0;
    }
    const EmbreeScene embree(scene);
    const bool isGlossy = scene.name == "glossy-table";
    const bool isDim = scene.name == "glass-sphere" || isGlossy;
    RunOptions options;
    options.stop.batches = kBatches;
    LightTraceSettings light;
    light.width = kWidth;
    light.height = kHeight;
    light.photonsPerBatch = isGlossy ? 1u << 17 : 1u << 15;
    PixelSums traced = makeLightTraceSums(embree, light);
    lightTrace(embree, light, options, traced);
    PhotonMappingSettings mapping;
    mapping.width = kWidth;
    mapping.height = kHeight;
    mapping.photonsPerBatch = isGlossy ? 1u << 18 : isDim ? 1u << 16 : 1u << 15;
    mapping.seed = 2;  // independent photons
    mapping.initialRadiusPixels = isDim && !isGlossy ? 1.0 : 0.5;
    PixelSums mapped = makePhotonMappingSums(embree, mapping);
    photonMapping(embree, mapping, options, mapped);

    const auto expectAgreement = [&](int tracedLayer, int mappedLayer, const std::string& what) {
        SCOPED_TRACE(what);
        const Comparison found = compare(traced, tracedLayer, mapped, mappedLayer);
        const double share =
            static_cast<double>(found.agreeing) / static_cast<double>(found.tested);
        RecordProperty(what + "_agreeing_per_mille", std::to_string(1000.0 * share));
        RecordProperty(what + "_pixels_lit", std::to_string(found.lit));
        RecordProperty(what + "_pixels_tested", std::to_string(found.tested));
        RecordProperty(what + "_energy_tested_per_mille",
                       std::to_string(1000.0 * found.sumTested / found.sumTraced));
        EXPECT_GE(share, 0.9975) << found.agreeing << " of " << found.tested;
        // What is left out is dim, but for the tip of a focus that lies within one or two pixels.
        ASSERT_GT(found.tested, 200u);
        EXPECT_GT(found.sumTested, (isDim ? 0.7 : 0.95) * found.sumTraced);
        // The whole picture, with all that was left out; 0.2 % for what the radius loses at the
        // edges of surfaces.
        EXPECT_NEAR(found.sumMapped, found.sumTraced,
                    5.0 * std::sqrt(found.variance) + 2e-3 * found.sumTraced);
    };
    expectAgreement(kIrradianceLayer, kExtrapolatedLayer, "irradiance");
    const int radianceLayer = causticRadianceLayer(scene);
    if (radianceLayer > 0) expectAgreement(radianceLayer, kMappedRadianceLayer, "radiance");
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement,
                         testing::Values("flat-water", "glass-sphere", "glossy-table", "pool",
                                         "ring"),
                         [](const auto& parameter) {
                             std::string name = parameter.param;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace kaustik::reference
