// SPDX-License-Identifier: MIT
// How the receiver that a pixel sees reflects towards the eye.
#include "include/surfaces/spread_lobe.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/views/view.glsl"

uniform sampler2D receiverAlbedo;

// The normal of what a pixel sees on the eye's side, and the direction towards the eye, unit.
void lookOf(ivec2 pixel, vec4 surface, out vec3 normal, out vec3 toEye) {
    toEye = -normalize(viewRay(vec2(pixel) + 0.5));
    normal = dot(surface.xyz, toEye) < 0.0 ? -surface.xyz : surface.xyz;
}

// 1/sr. `surface`: the pixel's texel of receiverSurface; `toLight`: unit.
vec3 receiverReflection(ivec2 pixel, vec4 surface, vec3 toLight) {
    vec3 normal, toEye;
    lookOf(pixel, surface, normal, toEye);
    vec4 lobe = materials[uint(surface.w) - 1u].specular;
    return receiverBrdf(texelFetch(receiverAlbedo, pixel, 0).rgb, lobe.rgb, lobe.w, normal, toLight,
                        toEye);
}

// The mean over light from many directions, as spreadBrdf has it.
vec3 meanReflection(ivec2 pixel, vec4 surface, vec3 toMean, float resultant) {
    vec3 normal, toEye;
    lookOf(pixel, surface, normal, toEye);
    vec4 lobe = materials[uint(surface.w) - 1u].specular;
    return spreadBrdf(texelFetch(receiverAlbedo, pixel, 0).rgb, lobe.rgb, lobe.w, normal, toMean,
                      toEye, resultant);
}
