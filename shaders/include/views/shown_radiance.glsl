// SPDX-License-Identifier: MIT
// The light of receivers that the picture shows, for rays that come to them on other ways than the
// eye's own. GLOSSY_RECEIVERS: some have a lobe.
#include "include/photons/lights.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/views/view_sample.glsl"
#include "framework/transport/brdf.h"

uniform int lightCount;
#ifdef GLOSSY_RECEIVERS
uniform sampler2DArray directVisibility;
#endif

// Bilinear between those of the four pixels around the hit whose receivers lie on the hit's plane.
// False: there is none.
bool radianceAround(vec3 hitVs, vec3 normal, out vec3 radiance) {
    vec2 corner = pixelOf(hitVs) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    float reach = 2.0 * pixelFootprint(-hitVs.z);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 other = clamp(first + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        float depth = texelFetch(receiver, other, 0).x;
        if (depth <= 0.0) continue;
        if (abs(dot(normal, viewRay(vec2(other) + 0.5) * depth - hitVs)) > reach) continue;
        vec2 axis = mix(1.0 - f, f, vec2(step));
        sum += axis.x * axis.y * texelFetch(receiverRadiance, other, 0).rgb;
        weights += axis.x * axis.y;
    }
    bool isShown = weights > 1e-3;
    radiance = sum / max(weights, 1e-3);
    return isShown;
}

#ifdef GLOSSY_RECEIVERS
// What a glossy receiver sends back along a ray instead of to the eye, of the direct light that the
// image has there, W/m²/sr; the caustic's part stays as the eye sees it. `shaded`: unit, the
// receiver's outward normal.
vec3 lobeRadiance(vec3 hitVs, vec3 direction, ivec2 texel, vec3 shaded, uint material) {
    vec4 lobe = materials[material - 1u].specular;
    vec3 difference = vec3(0.0);
    if (lobe.rgb == vec3(0.0)) return difference;
    vec3 normal = dot(shaded, hitVs) > 0.0 ? -shaded : shaded;
    vec3 toEye = -normalize(hitVs);
    for (int i = 0; i < lightCount; ++i) {
        vec3 toLight = -lightDirection(lights[i], hitVs);
        vec3 reflected =
            receiverBrdf(vec3(0.0), lobe.rgb, lobe.w, normal, toLight, -direction) -
            receiverBrdf(vec3(0.0), lobe.rgb, lobe.w, normal, toLight, toEye);
        difference += lightIrradiance(lights[i], hitVs) * max(dot(normal, toLight), 0.0) *
                      texelFetch(directVisibility, ivec3(texel, i), 0).x * reflected;
    }
    return difference;
}
#endif

// Of a receiver that the image shows at `texel`, or in a pixel next to it, back along a ray; where
// it does not, what is at `texel`. `normal`: the triangle's, unit; `shaded`: the surface's.
vec3 radianceOfSeen(vec3 hitVs, vec3 direction, ivec2 texel, vec3 normal, uint material,
                    vec3 shaded) {
    vec3 radiance;
    if (!radianceAround(hitVs, normal, radiance))
        radiance = texelFetch(receiverRadiance, texel, 0).rgb;
#ifdef GLOSSY_RECEIVERS
    radiance += lobeRadiance(hitVs, direction, texel, shaded, material);
#endif
    return max(radiance, vec3(0.0));
}
