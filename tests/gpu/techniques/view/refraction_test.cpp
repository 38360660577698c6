// SPDX-License-Identifier: MIT
// view.refraction on the device.
#include <algorithm>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// Water absorbs all of the light of a path without end: an eye's ray that has entered it, and looks
// for nothing there, brings but what is reflected. Mesa's software rasteriser once kept the 0 that
// threads read in a loop that they had left already, and pixels in blocks of eight were taken to
// have come out of the water again.
TEST(Refraction, KeepsTheMediumOfRaysThatHaveLeftTheirLoops) {
    const scene::Scene scene = scene::loadScene("pool");
    const Frame frame(scene, 800, 600,
                      {{"emit.photons", "8x8"},
                       {"shadow.map.size", "64"},
                       {"view.refraction.scene", "false"},
                       {"view.refraction.reflection", "false"},
                       {"view.refraction.interfaces", "1"}},
                      {"view.radiance", "view.exit_position"});
    const Texels radiance = frame.read("view.radiance");
    const Texels exits = frame.read("view.exit_position");
    std::size_t entered = 0;
    std::size_t bright = 0;
    for (int y = 0; y < 600; ++y) {
        for (int x = 0; x < 800; ++x) {
            if (exits.values[4 * (static_cast<std::size_t>(y) * 800 + static_cast<std::size_t>(x)) +
                             3] < 1.0f)
                continue;
            ++entered;
            // Where the eye looks down at water it reflects less than a third.
            bright += radiance.rgb(x, y).g > 0.5 * scene.backgroundRadiance.g ? 1 : 0;
        }
    }
    EXPECT_GT(entered, 100000u);
    EXPECT_EQ(bright, 0u);
}

}  // namespace
}  // namespace kaustik::test
