// SPDX-License-Identifier: MIT
// The first specular surface of each pixel, where it lies in front of the receiver.
#include "include/surfaces/fragment_normal.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface.glsl"

layout(location = 0) out vec4 interfaceDepth;
layout(location = 1) out vec4 interfaceSurface;

void main() {
    float depth = -positionVs.z;
    vec3 geometric = geometricNormal(positionVs, -positionVs);
    interfaceDepth = vec4(depth, 0.5 * fwidth(depth), 0.0, 0.0);
    interfaceSurface = vec4(fragmentNormal(geometric), float(material + 1u));
}
