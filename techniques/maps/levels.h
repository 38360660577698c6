// SPDX-License-Identifier: MIT
// A map with coarser levels of itself: shaders/maps/levels.glsl says where they lie.
#pragma once

#include <algorithm>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Down to eight texels, so that all beyond the first fit side by side.
inline int levelsOf(int width, int height) {
    int levels = 1;
    while (std::min(width, height) >> levels >= 8)
        ++levels;
    return levels;
}

inline void setLevelLayout(gl::Command& command, const FluxMap& map) {
    command.set("levelZero", glm::ivec2(map.on.views->width(), map.on.views->height()));
}

}  // namespace kaustik
