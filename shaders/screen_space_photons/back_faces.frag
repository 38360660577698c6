// SPDX-License-Identifier: MIT
// The back faces of the transmitting objects, the farthest of each pixel (W05).
#include "include/scene_fragment.glsl"
#include "include/surface.glsl"

layout(location = 0) out vec4 backDepth;
layout(location = 1) out vec4 backSurface;

void main() {
    float depth = -positionVs.z;
    float extent = 0.5 * fwidth(depth);
    vec3 geometric = geometricNormal(positionVs, -positionVs);
    if (gl_FrontFacing) discard;
    backDepth = vec4(depth, extent, 0.0, 0.0);
    backSurface = vec4(shadingNormal(normalVs, geometric), float(material + 1u));
}
