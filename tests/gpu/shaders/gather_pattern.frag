// SPDX-License-Identifier: MIT
// Irradiance with a closed form. r: a constant for each material; g: waves over the world's x and
// z; b: noise, even in [0, 1000], that differs from pixel to pixel and from seed to seed.
#include "include/views/view.glsl"

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform vec3 eyeFromOrigin;  // m
uniform uint seed;
uniform uint seedOfNaN;  // of a frame with pixels that are no numbers

layout(location = 0) out vec4 irradiance;
#ifdef HAS_RADIANCE
layout(location = 1) out vec4 radiance;
#endif

uint hash(uint x) {
    x ^= x >> 16u;
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    return x ^ (x >> 16u);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(receiver, pixel, 0).x;
    irradiance = vec4(0.0);
    if (depth > 0.0) {
        vec3 place = mat3(view.viewToWorld) * viewPoint(gl_FragCoord.xy, depth) + eyeFromOrigin;
        uint bits = hash(uint(pixel.x) ^ hash(uint(pixel.y) ^ hash(seed)));
        irradiance.r = 100.0 * texelFetch(receiverSurface, pixel, 0).w;
        irradiance.g = 1000.0 * (1.5 + sin(3.0 * place.x) * sin(3.0 * place.z));
        irradiance.b = 1000.0 * float(bits >> 8u) / 16777215.0;
        if (seed == seedOfNaN && pixel.x % 4 == 0) irradiance.g = uintBitsToFloat(0x7fc00000u);
    }
#ifdef HAS_RADIANCE
    radiance = 2.0 * irradiance;
#endif
}
