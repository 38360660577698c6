// SPDX-License-Identifier: MIT
// Tracers that share steps and hit test find the same: a march asks one after the other what lines
// ask all at once.
#include <cmath>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

class Marching : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Marching, FindsTheHitsOfTheLines) {
    const auto& [node, test] = GetParam();
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const auto settings = [&, t = test](const char* tracer) {
        return Frame::Settings{{"trace", tracer}, {"trace.test", t}, {"emit.photons", "64x64"}};
    };
    const std::vector<std::string> saved = {"hits.position_2", "hits.surface_2", "hits.flux_2"};
    const Frame lines(scene, 160, 120, settings("lines"), saved);
    const Frame marched(scene, 160, 120, settings(node), saved);
    for (const std::string& name : saved) {
        const Texels expected = lines.read(name);
        const Texels found = marched.read(name);
        double largest = 0.0;
        for (std::size_t i = 0; i < expected.values.size(); ++i) {
            largest = std::max(largest,
                               static_cast<double>(std::abs(expected.values[i] - found.values[i])));
        }
        // The same operations in another order of instructions: some units of the last place at
        // some metres, over four interactions.
        EXPECT_LT(largest, 1e-4) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Every, Marching,
    testing::Combine(testing::Values("march", "march_compute", "hierarchical",
                                     "hierarchical_compute"),
                     testing::Values("crossing", "epsilon", "in_out")),
    [](const testing::TestParamInfo<std::tuple<const char*, const char*>>& tested) {
        return std::string(std::get<0>(tested.param)) + "_" + std::get<1>(tested.param);
    });

}  // namespace
}  // namespace kaustik::test
