// SPDX-License-Identifier: MIT
// Share of one light that reaches each receiver past the surfaces of its shadow map. A texel of the
// map stands for the plane of its triangle, so that a surface seen edge-on from the light neither
// shadows itself nor lets light pass beside it. Comparisons are filtered, never depths
// (percentage-closer filtering, Reeves et al. 1987), by a square as wide as three texels, or as the
// pixel is on the map where that is more.
#include "include/light_depth.glsl"
#include "include/view.glsl"

layout(location = 0) out vec4 visibility;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform sampler2DArray shadowMap;
uniform int firstLayer;
uniform int faceCount;
uniform mat4 eyeToLight[6];
uniform mat4 projection;

// Side of the square that one look at the map averages over, texels.
const float kFilterWidth = 3.0;
// Most looks along each side of a pixel.
const int kMostLooks = 3;

// A point on the map of a light.
struct MapPoint {
    int face;  // -1: beside the map
    vec2 at;   // texels
    vec2 texelMeters;  // what a texel covers there
    float depth;       // from the light, m
};

MapPoint mapPoint(vec3 positionVs) {
    vec2 size = vec2(textureSize(shadowMap, 0).xy);
    for (int face = 0; face < faceCount; ++face) {
        vec3 positionLs = (eyeToLight[face] * vec4(positionVs, 1.0)).xyz;
        vec4 clip = projection * vec4(positionLs, 1.0);
        if (clip.w <= 0.0 || any(greaterThan(abs(clip.xy), vec2(clip.w)))) continue;
        return MapPoint(face, (clip.xy / clip.w * 0.5 + 0.5) * size,
                        2.0 * clip.w / (vec2(projection[0][0], projection[1][1]) * size),
                        -positionLs.z);
    }
    return MapPoint(-1, vec2(0.0), vec2(1.0), 0.0);
}

// Share of the light that reaches the point: of the square around it each texel has the part that
// lies in it, so that the share has no steps where the picture magnifies the map.
float visibleShare(MapPoint point, vec3 normalVs) {
    if (point.face < 0) return 1.0;  // nothing is there to throw a shadow
    ivec2 size = textureSize(shadowMap, 0).xy;
    vec3 normalLs = mat3(eyeToLight[point.face]) * normalVs;
    vec2 corner = point.at - 0.5 * kFilterWidth;
    ivec2 first = ivec2(floor(corner));
    vec2 beside = corner - vec2(first);
    const int kTexels = int(kFilterWidth) + 1;
    float lit = 0.0;
    float dark = 0.0;
    for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
            ivec2 texel = clamp(first + ivec2(x, y), ivec2(0), size - 1);
            vec4 nearest = texelFetch(shadowMap, ivec3(texel, firstLayer + point.face), 0);
            vec2 fromTexel = point.at - (vec2(texel) + 0.5);
            vec2 part = vec2(x == 0 ? 1.0 - beside.x : x == kTexels - 1 ? beside.x : 1.0,
                             y == 0 ? 1.0 - beside.y : y == kTexels - 1 ? beside.y : 1.0);
            if (reachesLight(nearest, fromTexel, point.texelMeters, point.depth, normalLs)) {
                lit += part.x * part.y;
            } else {
                dark += part.x * part.y;
            }
        }
    }
    // Exactly 1 or 0 where all texels say the same.
    return lit / (lit + dark);
}

// What is seen `offset` pixels beside the middle of this one, on the plane of its receiver; bounded
// where that is seen edge-on.
vec3 besideMiddle(vec2 offset, float depth, vec3 normalVs) {
    vec3 ray = viewRay(gl_FragCoord.xy + offset);
    vec3 middle = viewRay(gl_FragCoord.xy);
    float reach = kSteepestSlope * pixelFootprint(depth);
    float there = depth * dot(normalVs, middle) / dot(normalVs, ray);
    // Not a number where the plane is seen exactly edge-on: then it is as deep as the middle.
    bool isKnown = abs(there - depth) < 1e30;
    return ray * (isKnown ? clamp(there, depth - reach, depth + reach) : depth);
}

// How many looks along a side of the pixel cover it on the map.
int looksAcross(MapPoint middle, float depth, vec3 normalVs) {
    float texels = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        MapPoint edge = mapPoint(besideMiddle(0.5 * vec2(1 - axis, axis), depth, normalVs));
        // On another face: as on this one, for all that the number of looks depends on.
        if (edge.face == middle.face) texels = max(texels, 2.0 * distance(edge.at, middle.at));
    }
    return int(clamp(ceil(texels / kFilterWidth), 1.0, float(kMostLooks)));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    visibility = vec4(0.0);
    float depth = texelFetch(receiver, pixel, 0).x;
    if (depth <= 0.0) return;
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    MapPoint middle = mapPoint(viewRay(gl_FragCoord.xy) * depth);
    int looks = looksAcross(middle, depth, normal);
    float sum = 0.0;
    for (int i = 0; i < looks * looks; ++i) {
        vec2 offset = (vec2(i % looks, i / looks) + 0.5) / float(looks) - 0.5;
        sum += visibleShare(
            looks == 1 ? middle : mapPoint(besideMiddle(offset, depth, normal)), normal);
    }
    visibility = vec4(sum / float(looks * looks));
}
