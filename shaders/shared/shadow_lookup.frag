// SPDX-License-Identifier: MIT
// Share of one light that reaches each receiver past the surfaces of its shadow map. A texel of the
// map stands for the plane of its triangle, so that a surface seen edge-on from the light neither
// shadows itself nor lets light pass beside it.
#include "include/view.glsl"

layout(location = 0) out vec4 visibility;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform sampler2DArray shadowMap;
uniform int firstLayer;
uniform int faceCount;
uniform mat4 eyeToLight[6];
uniform mat4 projection;

// By how much a curved surface may lie beyond the plane of a triangle beside it, in what its depth
// differs by over a texel. More takes less of `tree` for the wrong side and more of
// `cornell-bunny`: with 0.25, 0.5, 1 and 2 it is 1.01, 0.97, 0.96, 0.93 % and 0.04, 0.04, 0.07,
// 0.12 % (400x300).
const float kCurvature = 0.5;

// Share of the light that reaches the point: the mean of 3x3 comparisons.
float visibleShare(vec3 positionVs, vec3 normalVs) {
    ivec2 size = textureSize(shadowMap, 0).xy;
    for (int face = 0; face < faceCount; ++face) {
        vec3 positionLs = (eyeToLight[face] * vec4(positionVs, 1.0)).xyz;
        vec3 normalLs = mat3(eyeToLight[face]) * normalVs;
        vec4 clip = projection * vec4(positionLs, 1.0);
        if (clip.w <= 0.0 || any(greaterThan(abs(clip.xy), vec2(clip.w)))) continue;
        vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * vec2(size);
        ivec2 middle = ivec2(floor(at));
        float depth = -positionLs.z;
        // Metres that a texel covers at the point.
        vec2 texelMeters = 2.0 * clip.w /
                           (vec2(projection[0][0], projection[1][1]) * vec2(size));
        float lit = 0.0;
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                ivec2 texel = clamp(middle + ivec2(x, y), ivec2(0), size - 1);
                vec4 nearest = texelFetch(shadowMap, ivec3(texel, firstLayer + face), 0);
                vec2 growth = nearest.yz * nearest.x;
                float extent = abs(growth.x) + abs(growth.y);
                float beside = dot(growth, at - (vec2(texel) + 0.5));
                float plane = nearest.x + clamp(beside, -2.0 * extent, 2.0 * extent);
                // A surface that turns by more than 60 degrees is another one.
                vec3 blocker = normalize(vec3(growth / texelMeters, 1.0));
                bool isSame = abs(dot(blocker, normalLs)) > 0.5;
                float margin = (isSame ? kCurvature * extent : 0.0) + 1e-4 * depth;
                lit += nearest.x <= 0.0 || depth <= plane + margin ? 1.0 : 0.0;
            }
        }
        return lit / 9.0;
    }
    return 1.0;  // beside the map: nothing is there to throw a shadow
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(receiver, pixel, 0).x;
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    visibility =
        vec4(depth > 0.0 ? visibleShare(viewRay(gl_FragCoord.xy) * depth, normal) : 0.0);
}
