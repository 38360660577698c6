// SPDX-License-Identifier: MIT
// Planar depth from the light, m, and what it grows by from texel to texel, as a share of it.
in vec3 positionVs;

layout(location = 0) out vec4 lightDepth;

void main() {
    float depth = -positionVs.z;
    vec2 growth = vec2(dFdx(depth), dFdy(depth)) / depth;
    lightDepth = vec4(depth, clamp(growth, vec2(-1.0), vec2(1.0)), 0.0);
}
