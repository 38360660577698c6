// SPDX-License-Identifier: MIT
// Planar depth from the light, m, and half of its extent over the texel: how far the map's surface
// may differ from a point that the texel also covers.
in vec3 positionVs;

layout(location = 0) out vec4 lightDepth;

void main() {
    float depth = -positionVs.z;
    lightDepth = vec4(depth, fwidth(depth), 0.0, 0.0);
}
