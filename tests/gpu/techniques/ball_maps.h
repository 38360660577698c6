// SPDX-License-Identifier: MIT
// A ball of glass above a floor under lamps, and its caustic maps of dense grids: what tests of
// adaptive and of hierarchical maps share.
#pragma once

#include <fmt/format.h>

#include <string>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/caustic_map_frame.h"

namespace kaustik::test {

using numerics::Settings;

inline const numerics::CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};

inline std::string lamp(const std::string& name, const glm::dvec3& position,
                        const glm::dvec3& direction) {
    return fmt::format(
        "[[light]]\nname = \"{}\"\ntype = \"spot\"\nposition = {}\ndirection = {}\n"
        "inner_cone_degrees = 25\nouter_cone_degrees = 30\nintensity = 100\n",
        name, numerics::numbers(position), numerics::numbers(direction));
}

// Towards the origin.
inline std::string lamp(const std::string& name, const glm::dvec3& position) {
    return lamp(name, position, -position);
}

inline const std::string kFloor = numerics::floorPlane("floor", "grey", 6, {0, 0, 0});
inline const std::string kBall =
    numerics::object("ball", "sphere", "glass", {0, 0.8, 0}, "radius = 0.4\nsegments = 48");

inline scene::Scene ballScene(const std::string& lights) {
    return numerics::makeScene(kAbove, lights + kFloor + kBall);
}

inline Settings with(Settings settings, const Settings& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

inline MapFrame gridded(const scene::Scene& scene, const std::string& technique,
                        const Settings& more) {
    return {scene, technique,
            with({{"emit", "deferred"},
                  {"specular", "deferred"},
                  {"emit.photons", "256x256"},
                  {"emit.deferred.size", "256"},
                  {"reconstruct.map_size", "128"},
                  {"reconstruct.fixed.diameter", "3"}},
                 more)};
}

inline transport::CellCounts countsOf(const MapFrame& frame) {
    return frame.renderer()
        .buffer(frame.renderer().outputs().cells)
        .read<transport::CellCounts>()
        .front();
}

}  // namespace kaustik::test
