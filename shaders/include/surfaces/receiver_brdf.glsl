// SPDX-License-Identifier: MIT
// How the receiver that a pixel sees reflects towards the eye.
#include "framework/transport/brdf.h"
#include "include/surfaces/surface_data.glsl"
#include "include/views/view.glsl"

uniform sampler2D receiverAlbedo;

// 1/sr. `surface`: the pixel's texel of receiverSurface; `toLight`: unit. The normal is taken on
// the eye's side.
vec3 receiverReflection(ivec2 pixel, vec4 surface, vec3 toLight) {
    vec3 toEye = -normalize(viewRay(vec2(pixel) + 0.5));
    vec3 normal = dot(surface.xyz, toEye) < 0.0 ? -surface.xyz : surface.xyz;
    vec4 lobe = materials[uint(surface.w) - 1u].specular;
    return receiverBrdf(texelFetch(receiverAlbedo, pixel, 0).rgb, lobe.rgb, lobe.w, normal, toLight,
                        toEye);
}
