// SPDX-License-Identifier: MIT
// The environment of a scene, on the device: the colour of each direction is that of the picture
// there, whichever way the eye looks and the picture is turned.
#include "framework/scene/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// Whether all texels around a place of the picture have its colour: bilinear or not is then the
// same.
bool isEven(const Image& image, int column, int row, int reach) {
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            const int x = ((column + dx) % image.width + image.width) % image.width;
            const int y = std::clamp(row + dy, 0, image.height - 1);
            for (int c = 0; c < 3; ++c) {
                if (std::abs(image.at(x, y, c) - image.at(column, row, c)) > 0.01f) return false;
            }
        }
    }
    return true;
}

TEST(Environment, HasItsPicturesColourInEveryDirection) {
    const Image picture = scene::makeEnvironment(scene::EnvironmentPattern::grid);
    for (const double turn : {0.0, 77.0}) {
        for (const glm::dvec3& target :
             {glm::dvec3(0, 0, -1), glm::dvec3(1, 0.2, 0.3), glm::dvec3(-0.2, 1, 0.1),
              glm::dvec3(0.1, -1, 0.3), glm::dvec3(-0.3, 0, 1)}) {
            const scene::Scene scene = sceneFromText(fmt::format(
                "background_radiance = 2\n[environment]\npattern = \"grid\"\nturn_degrees = {}\n"
                "[camera]\nposition = [0, 0, 0]\ntarget = [{}, {}, {}]\n"
                "vertical_fov_degrees = 60\n",
                turn, target.x, target.y, target.z));
            const Frame frame(scene, 80, 60);
            const Texels seen = frame.read(frame.renderer().outputs().picture.radiance);
            int compared = 0;
            for (int y = 0; y < 60; ++y) {
                for (int x = 0; x < 80; ++x) {
                    const glm::dvec3 direction = glm::normalize(frame.worldAt(x, y, 1.0));
                    const glm::dvec2 at = environmentPosition(scene, direction);
                    const int column =
                        std::min(static_cast<int>(at.x * picture.width), picture.width - 1);
                    const int row = std::clamp(static_cast<int>((1.0 - at.y) * picture.height), 0,
                                               picture.height - 1);
                    if (!isEven(picture, column, row, 3)) continue;
                    ++compared;
                    for (int c = 0; c < 3; ++c) {
                        // Half floats, of a picture that changes by 1 % within the texels around.
                        ASSERT_NEAR(seen.at(x, y, c), 2.0f * picture.at(column, row, c), 0.03f)
                            << x << " " << y << " turned by " << turn;
                    }
                }
            }
            EXPECT_GT(compared, 1000);
        }
    }
}

}  // namespace
}  // namespace kaustik::test
