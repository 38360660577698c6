// SPDX-License-Identifier: MIT
// Parts of scenes, as TOML, that many tests share.
#pragma once

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <string>

#include "framework/numerics/cases/scene_text.h"

namespace kaustik::test {

// The object "floor", a square that faces up, of the material "grey", which reflects half and is
// declared here.
inline std::string greyFloor(double side, double height = 0.0) {
    return "[[material]]\nname = \"grey\"\ntype = \"lambertian\"\nalbedo = 0.5\n" +
           numerics::floorPlane("floor", "grey", side, {0.0, height, 0.0});
}

// The object "water", 2 x 1.5 m at the origin with waves of 2 cm, which makes light of some
// structure. Its material is one of makeScene's.
inline std::string rippledWater(const glm::ivec2& cells = {96, 72}) {
    return numerics::object("water", "water", "water", {0.0, 0.0, 0.0},
                            fmt::format("size = [2, 1.5]\ncells = [{}, {}]\n"
                                        "waves = [{{amplitude = 0.02, wavelength = 0.6}}]",
                                        cells.x, cells.y));
}

}  // namespace kaustik::test
