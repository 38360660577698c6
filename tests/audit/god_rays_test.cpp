// SPDX-License-Identifier: MIT
// God rays against the ray-traced single scattering of the same paths of light: through one
// interface on the flooded cave, which the eye is in, and through a ball of glass, where a photon's
// way has several parts and those in the glass scatter too.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/measure/image_errors.h"
#include "framework/reference/reference.h"
#include "framework/scene/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

reference::Reference truthOf(const scene::Scene& scene, const ModelledPaths& paths) {
    const reference::EmbreeScene embree(scene);
    reference::ReferenceRequest request;
    request.width = kWidth;
    request.height = kHeight;
    request.filter.transmissionOnly = paths.transmissionOnly;
    request.filter.maximumInteractions = paths.interactions;
    reference::RunOptions options;
    options.stop.photons = 6'000'000;
    reference::PixelSums sums = makeSums(embree, request);
    addBatches(embree, request, options, sums);
    return makeReference(scene, request, sums, 0.0);
}

void expectTruth(const scene::Scene& scene, const Settings& settings, double energyTolerance,
                 double errorTolerance) {
    const Frame frame(scene, kWidth, kHeight, settings);
    const FrameOutputs& outputs = frame.renderer().outputs();
    const reference::Reference truth = truthOf(scene, outputs.hits.incoming.paths);
    const Texels texels = frame.read(outputs.inScattered.radiance);
    Image image(texels.width, texels.height, 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = texels.at(x, image.height - 1 - y, c);
        }
    }
    const measure::ImageErrors errors =
        measureErrors(measure::ImagePair({.image = image,
                                          .reference = truth.inScattered,
                                          .standardError = &truth.inScatteredError}));
    ASSERT_TRUE(errors.energyRatio && errors.truthNoise);
    EXPECT_NEAR(*errors.energyRatio, 1.0, energyTolerance);
    double mean = 0.0;
    for (const float value : truth.inScattered.values)
        mean += static_cast<double>(value) / static_cast<double>(truth.inScattered.values.size());
    // What the truth's own noise does not explain.
    const double own = std::sqrt(std::max(
        errors.rmse * errors.rmse - errors.truthNoise->rmse * errors.truthNoise->rmse, 0.0));
    testing::Test::RecordProperty("energy_ratio_ppm", static_cast<int>(1e6 * *errors.energyRatio));
    testing::Test::RecordProperty("error_ppm", static_cast<int>(1e6 * own / mean));
    EXPECT_LT(own / mean, errorTolerance);
}

TEST(GodRays, AreTheTruthsOnTheFloodedCave) {
    // A pixel's middle says for all of it what hides the shafts behind: at outlines that is wrong,
    // and all that is left of the error.
    expectTruth(scene::loadScene("god-rays"), {{"blur", "none"}, {"trace", "hierarchical_compute"}},
                0.01, 0.08);
}

TEST(GodRays, AreTheTruthsThroughABallOfGlass) {
    scene::Scene scene = scene::loadScene("glass-sphere");
    scene.medium = scene::Medium{{0.3f, 0.2f, 0.1f}, {0.0f, 0.1f, 0.2f}, 0.3f};
    expectTruth(scene, {{"blur", "none"}, {"trace", "hierarchical_compute"}}, 0.02, 0.15);
}

}  // namespace
}  // namespace kaustik::test
