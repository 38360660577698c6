// SPDX-License-Identifier: MIT
// Frames that are timed without the energy ledger (RenderSettings::hasLedger): the same light to
// the bit, and nothing is added up.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "framework/run/settings.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// By a technique; and as a GPU does it, or with the processor where it is the device.
class WithoutALedger : public testing::TestWithParam<std::tuple<const char*, bool>> {};

TEST_P(WithoutALedger, TheLightIsTheSameAndNoProgramKnowsOfOne) {
    const Registry registry = registerAll();
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const auto rendered = [&](bool hasLedger, std::vector<gl::UsedProgram>& programs) {
        RenderSettings settings =
            run::makeSettings({.technique = std::get<0>(GetParam()),
                               .assignments = {{"emit.photons", "32x32", "test"}}},
                              registry);
        settings.width = 64;
        settings.height = 48;
        settings.hasLedger = hasLedger;
        settings.asOnGpu = std::get<1>(GetParam());
        Renderer renderer(context(), registry, scene, settings);
        renderer.build(Purpose::picture);
        programs = renderer.listPrograms();
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer.renderFrame(timer);
        const FrameOutputs& outputs = renderer.outputs();
        return std::pair(renderer.texture(outputs.caustic.irradiance).read(),
                         renderer.texture(outputs.picture.radiance).read());
    };
    std::vector<gl::UsedProgram> with;
    std::vector<gl::UsedProgram> without;
    const auto expected = rendered(true, with);
    EXPECT_GT(*std::max_element(expected.first.begin(), expected.first.end()), 0.0f);
    EXPECT_TRUE(rendered(false, without) == expected);
    const auto knows = [](const gl::UsedProgram& used) {
        return used.key.declarations.find("NO_LEDGER") != std::string::npos;
    };
    EXPECT_FALSE(std::any_of(with.begin(), with.end(), knows));
    EXPECT_TRUE(std::all_of(without.begin(), without.end(), knows));
}

INSTANTIATE_TEST_SUITE_P(Of, WithoutALedger,
                         testing::Combine(testing::Values("exact_rays", "screen_space_photons",
                                                          "caustic_triangles",
                                                          "adaptive_caustic_map"),
                                          testing::Bool()));

}  // namespace
}  // namespace kaustik::test
