// SPDX-License-Identifier: MIT
// The eye's view in this frame and the one before, for what looks up where a point was seen then.
// C++ and GLSL both read this file.
#pragma once

#include "framework/transport/types.h"

#ifdef __cplusplus
namespace kaustik::temporal {
using glm::mat4;
using glm::uvec4;
using glm::vec4;
#endif

// The eye's position has two floats a coordinate: near the origin or 1e5 m from it, what the eye
// has moved by is right to a tenth of a micrometre.
struct PastView {
    vec4 eyeWholeMeters;  // xyz: in the world
    vec4 eyeRest;         // xyz: the rest, m, from 0 to 1
    mat4 viewToWorld;     // rotation only
    vec4 frustum;         // ViewData's
};

struct PastViews {
    PastView before;  // zeros in the first frame
    PastView now;
    uvec4 turn;  // x: 0 and 1 in turn, from frame to frame
};

#ifdef __cplusplus
}  // namespace kaustik::temporal
#endif
