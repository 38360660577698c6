// SPDX-License-Identifier: MIT
// What both ways to peel layers keep while they do.
#pragma once

#include "framework/gl/objects.h"

namespace kaustik {

struct CountTexel {  // fragments in the pixel
    static constexpr graph::Format format = graph::Format::r32f;
};
// An indirect draw (peel_commands.comp).
struct DrawCommandWords {
    GLuint words[5];
};

}  // namespace kaustik
