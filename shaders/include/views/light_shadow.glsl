// SPDX-License-Identifier: MIT
// How much of a light reaches a point past the surfaces of its shadow map
// (techniques/raster_views/shadow_maps.h), wherever the point is. A texel of the map stands for the
// plane of its triangle, so that a surface seen edge-on from the light neither shadows itself nor
// lets light pass next to it. Comparisons are filtered, never depths (percentage-closer filtering,
// Reeves et al. 1987), by a square as wide as three texels.
#include "include/photons/lights.glsl"
#include "include/views/light_depth.glsl"
#include "techniques/raster_views/shadow_view.h"

uniform sampler2DArray shadowMap;
layout(std430) readonly buffer ShadowViews {
    ShadowView shadowViews[];  // by layer of the map
};

// Side of the square that one look at the map averages over, texels.
const float kShadowFilterWidth = 3.0;

// The layers of a light: from x, y of them.
ivec2 shadowLayersOf(int light) {
    ivec2 layers = ivec2(0);
    for (int i = 0; i <= light; ++i) {
        layers.x += layers.y;
        layers.y = uint(lights[i].positionVs.w) == kLightDirectional ? 1 : 6;
    }
    return layers;
}

// A point on the map of a light.
struct ShadowPlace {
    int layer;  // -1: next to the map
    vec2 at;    // texels
    vec2 texelMeters;  // what a texel covers there
    float depth;       // from the light, m
    float fromEye;     // m
};

ShadowPlace shadowPlaceOf(vec3 positionVs, ivec2 layers) {
    vec2 size = vec2(textureSize(shadowMap, 0).xy);
    for (int layer = layers.x; layer < layers.x + layers.y; ++layer) {
        mat4 projection = shadowViews[layer].projection;
        vec3 positionLs = (shadowViews[layer].eyeToLight * vec4(positionVs, 1.0)).xyz;
        vec4 clip = projection * vec4(positionLs, 1.0);
        if (clip.w <= 0.0 || any(greaterThan(abs(clip.xy), vec2(clip.w)))) continue;
        return ShadowPlace(layer, (clip.xy / clip.w * 0.5 + 0.5) * size,
                           2.0 * clip.w / (vec2(projection[0][0], projection[1][1]) * size),
                           -positionLs.z, length(positionVs));
    }
    return ShadowPlace(-1, vec2(0.0), vec2(1.0), 0.0, 0.0);
}

// Share of the light that reaches the place: of the square around it each texel has the part that
// lies in it, so that the share has no steps where the picture magnifies the map.
float visibleShare(ShadowPlace place, vec3 normalVs) {
    if (place.layer < 0) return 1.0;  // nothing is there to throw a shadow
    ivec2 size = textureSize(shadowMap, 0).xy;
    vec3 normalLs = mat3(shadowViews[place.layer].eyeToLight) * normalVs;
    vec2 corner = place.at - 0.5 * kShadowFilterWidth;
    ivec2 first = ivec2(floor(corner));
    vec2 neighbour = corner - vec2(first);
    const int kTexels = int(kShadowFilterWidth) + 1;
    float lit = 0.0;
    float dark = 0.0;
    for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
            ivec2 texel = clamp(first + ivec2(x, y), ivec2(0), size - 1);
            vec4 nearest = texelFetch(shadowMap, ivec3(texel, place.layer), 0);
            vec2 fromTexel = place.at - (vec2(texel) + 0.5);
            vec2 part = vec2(x == 0 ? 1.0 - neighbour.x : x == kTexels - 1 ? neighbour.x : 1.0,
                             y == 0 ? 1.0 - neighbour.y : y == kTexels - 1 ? neighbour.y : 1.0);
            if (reachesLight(nearest, fromTexel, place.texelMeters, place.depth, place.fromEye,
                             normalLs)) {
                lit += part.x * part.y;
            } else {
                dark += part.x * part.y;
            }
        }
    }
    // Exactly 1 or 0 where all texels say the same, whatever a driver makes of x / x.
    return dark > 0.0 ? lit / (lit + dark) : 1.0;
}
