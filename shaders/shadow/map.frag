// SPDX-License-Identifier: MIT
// Share of one light that reaches each receiver past the surfaces of its shadow map. A texel of the
// map stands for the plane of its triangle, so that a surface seen edge-on from the light neither
// shadows itself nor lets light pass next to it. Comparisons are filtered, never depths
// (percentage-closer filtering, Reeves et al. 1987), by a square as wide as three texels, or over the
// pixel where that is more than twice as wide on the map.
#include "include/views/light_depth.glsl"
#include "include/views/view.glsl"

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
const int kMaxSamples = 3;

// A point on the map of a light.
struct MapPoint {
    int face;  // -1: next to the map
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
    vec2 neighbour = corner - vec2(first);
    const int kTexels = int(kFilterWidth) + 1;
    float lit = 0.0;
    float dark = 0.0;
    for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
            ivec2 texel = clamp(first + ivec2(x, y), ivec2(0), size - 1);
            vec4 nearest = texelFetch(shadowMap, ivec3(texel, firstLayer + point.face), 0);
            vec2 fromTexel = point.at - (vec2(texel) + 0.5);
            vec2 part = vec2(x == 0 ? 1.0 - neighbour.x : x == kTexels - 1 ? neighbour.x : 1.0,
                             y == 0 ? 1.0 - neighbour.y : y == kTexels - 1 ? neighbour.y : 1.0);
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

// Whether the receiver is a plane as far as the pixels next to this one. At edges and where it is
// curved, points on its tangent plane would lie off it, in light or in shadow of their own.
bool isPlane(ivec2 pixel, vec3 positionVs, vec3 normalVs) {
    float maximum = 0.05 * pixelFootprint(-positionVs.z);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = (i & 1) == 0 ? ivec2(i - 1, 0) : ivec2(0, i - 2);
        ivec2 other = clamp(pixel + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        vec3 neighbour = viewRay(vec2(other) + 0.5) * texelFetch(receiver, other, 0).x;
        if (abs(dot(normalVs, neighbour - positionVs)) > maximum) return false;
    }
    return true;
}

// What is seen of the receiver's plane `offset` pixels next to this one's middle; the eye sees the
// pixels around of it too, so that it is not edge-on.
vec3 sampleOnPlane(vec2 offset, vec3 positionVs, vec3 normalVs) {
    vec3 ray = viewRay(gl_FragCoord.xy + offset);
    return ray * (dot(normalVs, positionVs) / dot(normalVs, ray));
}

// How many looks along a side of the pixel cover it on the map. One does up to twice its width: of
// the shadow at the pixel's middle it says more than their mean.
int looksAcross(MapPoint middle, vec3 positionVs, vec3 normalVs) {
    float texels = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        MapPoint edge = mapPoint(sampleOnPlane(0.5 * vec2(1 - axis, axis), positionVs, normalVs));
        // On another face: as on this one, for all that the number of looks depends on.
        if (edge.face == middle.face) texels = max(texels, 2.0 * distance(edge.at, middle.at));
    }
    if (texels < 2.0 * kFilterWidth) return 1;
    return min(int(ceil(texels / kFilterWidth)), kMaxSamples);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    visibility = vec4(0.0);
    float depth = texelFetch(receiver, pixel, 0).x;
    if (depth <= 0.0) return;
    vec3 positionVs = viewRay(gl_FragCoord.xy) * depth;
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    MapPoint middle = mapPoint(positionVs);
    int looks = isPlane(pixel, positionVs, normal) ? looksAcross(middle, positionVs, normal) : 1;
    float sum = 0.0;
    for (int i = 0; i < looks * looks; ++i) {
        vec2 offset = (vec2(i % looks, i / looks) + 0.5) / float(looks) - 0.5;
        sum += visibleShare(
            looks == 1 ? middle : mapPoint(sampleOnPlane(offset, positionVs, normal)), normal);
    }
    visibility = vec4(sum / float(looks * looks));
}
