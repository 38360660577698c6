// SPDX-License-Identifier: MIT
// What became of the eye's rays that meet a specular surface first.
#pragma once

#include <cstddef>

#include "framework/gl/objects.h"

namespace kaustik {

// Of the middles of pixels, one ray each; the first is the sum of the others.
struct EyeRays {
    std::size_t pixels = 0;
    std::size_t cameOut = 0;
    std::size_t lost = 0;             // where they go on is not known
    std::size_t reflectionLimit = 0;  // lost at the cap on total reflections
    std::size_t nestingLimit = 0;     // lost in more dielectrics than a stack holds
    std::size_t endedInside = 0;      // taken to see what they would from outside
    std::size_t mirrorLimit = 0;      // taken to see the environment

    // Of the pixels, in [0, 1]; 0 where there are none.
    [[nodiscard]] double shareOf(std::size_t rays) const;
};

// Of View::ending, which waits for the device.
[[nodiscard]] EyeRays countEyeRays(const gl::Texture& ending);

}  // namespace kaustik
