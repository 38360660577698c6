// SPDX-License-Identifier: MIT
// Share of one light that reaches each receiver past the surfaces of its shadow map.
#include "common/view.glsl"

layout(location = 0) out vec4 visibility;

uniform sampler2D receiver;
uniform sampler2DArray shadowMap;
uniform int firstLayer;
uniform int faceCount;
uniform mat4 eyeToLight[6];
uniform mat4 projection;

// Share of the light that reaches the point: the mean of 3x3 comparisons.
float visibleShare(vec3 positionVs) {
    ivec2 size = textureSize(shadowMap, 0).xy;
    for (int face = 0; face < faceCount; ++face) {
        vec3 positionLs = (eyeToLight[face] * vec4(positionVs, 1.0)).xyz;
        vec4 clip = projection * vec4(positionLs, 1.0);
        if (clip.w <= 0.0 || any(greaterThan(abs(clip.xy), vec2(clip.w)))) continue;
        ivec2 middle = ivec2(floor((clip.xy / clip.w * 0.5 + 0.5) * vec2(size)));
        float depth = -positionLs.z;
        float lit = 0.0;
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                ivec2 texel = clamp(middle + ivec2(x, y), ivec2(0), size - 1);
                vec2 nearest = texelFetch(shadowMap, ivec3(texel, firstLayer + face), 0).xy;
                float margin = 2.0 * nearest.y + 1e-4 * depth;
                lit += nearest.x <= 0.0 || depth <= nearest.x + margin ? 1.0 : 0.0;
            }
        }
        return lit / 9.0;
    }
    return 1.0;  // beside the map: nothing is there to throw a shadow
}

void main() {
    float depth = texelFetch(receiver, ivec2(gl_FragCoord.xy), 0).x;
    visibility = vec4(depth > 0.0 ? visibleShare(viewRay(gl_FragCoord.xy) * depth) : 0.0);
}
