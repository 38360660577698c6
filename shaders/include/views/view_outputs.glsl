// SPDX-License-Identifier: MIT
// What a pass that looks through specular surfaces draws of a pixel (View). Where its ray has left
// them for good is stored only where somebody asks for it (EXITS); of rays next to the pixel's
// middle nothing is but what they see. Outputs without a target are none: drivers warn of them.
#include "include/views/first_surface.glsl"
#include "include/views/path_ending.glsl"

layout(location = 0) out vec4 radiance;
#ifndef BESIDE_MIDDLE
layout(location = 1) out float pathEnding;
#endif
#ifdef EXITS
layout(location = 2) out vec4 exitPosition;   // as ExitPosition
layout(location = 3) out vec4 exitDirection;  // as ExitDirection
#else
vec4 exitPosition;
vec4 exitDirection;
#endif

// The last that such a shader does.
void finishPixel() {
    weigh(radiance);
#ifndef BESIDE_MIDDLE
    pathEnding = pathEndingOf(exitDirection);
#endif
}
