// SPDX-License-Identifier: MIT
// The default, whose photons are traced exactly, is nowhere further from the light of all paths
// than the screen's own search is: where light lands that the eye does not see it must not go to
// the pixels in front of it.
#include <gtest/gtest.h>

#include "framework/measure/image_errors.h"
#include "framework/scene/files/scene_file.h"
#include "tests/audit/caustic_errors.h"
#include "tests/audit/shipped_scenes.h"

namespace kaustik::test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

reference::Reference lightOfAllPaths(const reference::EmbreeScene& scene) {
    reference::ReferenceRequest request;
    request.width = kWidth;
    request.height = kHeight;
    reference::RunOptions options;
    options.stop.photons = 4'000'000;
    reference::PixelSums sums = makeSums(scene, request);
    addBatches(scene, request, options, sums);
    return makeReference(scene.scene(), request, sums, 0.0);
}

class ErrorOfExactRays : public testing::TestWithParam<std::string> {};

TEST_P(ErrorOfExactRays, IsNoMoreThanThatOfSearchesOnTheScreen) {
    const scene::Scene scene = scene::loadScene(GetParam());
    const Registry registry = registerAll();
    const reference::Reference reference = lightOfAllPaths(reference::EmbreeScene(scene));
    const auto errorsOf = [&](const std::string& technique) {
        const auto renderer = rendered(registry, scene, kWidth, kHeight, Purpose::audit,
                                       {{"emit.photons", "256x256"}}, false, technique);
        return causticErrors(*renderer, reference);
    };
    const measure::ImageErrors exact = errorsOf("exact_rays");
    const measure::ImageErrors screen = errorsOf("screen_space_photons");
    ASSERT_TRUE(exact.relMse && screen.relMse);
    // Both have the reference's noise in them, which no better picture takes away; a twentieth
    // more is no more on the scenes where both find the same hits.
    EXPECT_LE(*exact.relMse, 1.05 * *screen.relMse);
    RecordProperty("relmse_percent", static_cast<int>(100.0 * *exact.relMse / *screen.relMse));
}

INSTANTIATE_TEST_SUITE_P(Every, ErrorOfExactRays, testing::ValuesIn(shippedScenes()), nameOfScene);

}  // namespace
}  // namespace kaustik::test
