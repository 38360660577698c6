// SPDX-License-Identifier: MIT
// compose.picture's own exposure: that of a scene, not of a camera or a technique.
#include <cmath>
#include <string>

#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/scene_parts.h"

namespace kaustik::test {
namespace {

// A grey floor below the light `light`, as TOML, and whatever else.
scene::Scene lit(const std::string& light, double eyeHeight, const std::string& rest = "") {
    return sceneFromText("name = 'floor'\n[camera]\nposition = [0, " + std::to_string(eyeHeight) +
                         ", 0.01]\ntarget = [0, 0, 0]\n[[light]]\nname = 'light'\n" + light + "\n" +
                         greyFloor(4.0) + rest);
}

double shownInTheMiddle(const scene::Scene& scene, const std::string& technique) {
    const Frame frame(scene, 33, 25, {}, {"display"}, false, technique);
    return frame.read("display").rgb(16, 12).g;
}

TEST(Exposure, ShowsAHalfReflectingFloorUnderTheSunAsTheSameGreyAtEveryPower) {
    // 0.45 of the largest value that is shown, in sRGB.
    const double grey = 1.055 * std::pow(0.45, 1.0 / 2.4) - 0.055;
    for (const char* power : {"1e-3", "1", "1000", "1e6"}) {
        SCOPED_TRACE(power);
        const std::string sun =
            "type = 'directional'\ndirection = [0, -1, 0]\nirradiance = " + std::string(power);
        // Eight bits.
        EXPECT_NEAR(shownInTheMiddle(lit(sun, 2.0), "screen_space_photons"), grey,
                    0.5 / 255.0 + 1e-6);
        EXPECT_NEAR(shownInTheMiddle(lit(sun, 9.0), "planar"), grey, 0.5 / 255.0 + 1e-6);
    }
}

TEST(Exposure, ShowsARoomWhoseLampHangsInItNeitherDarkNorWhite) {
    // Also where the lamp is in the very middle, or outside.
    for (const char* height : {"0.5", "1", "1.9", "6"}) {
        SCOPED_TRACE(height);
        const std::string lamp =
            "type = 'point'\nintensity = 12\nposition = [0, " + std::string(height) + ", 0]";
        const double shown = shownInTheMiddle(lit(lamp, 0.4, R"(
[[object]]
name = "wall"
shape = "plane"
material = "grey"
size = [4, 4]
position = [0, 2, 0]
)"),
                                              "screen_space_photons");
        // The wall above is in the way of the last: only its shadow is seen.
        if (std::string(height) == "6") {
            EXPECT_EQ(shown, 0.0);
        } else {
            EXPECT_GT(shown, 0.4);
            EXPECT_LT(shown, 1.0);  // the shoulder keeps highlights
        }
    }
}

}  // namespace
}  // namespace kaustik::test
