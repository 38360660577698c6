// SPDX-License-Identifier: MIT
// What other views hold where one of the eye's receivers lies, over the texel's area on it.
#include "include/maps/flux_sum_read.glsl"
#include "include/views/view.glsl"

layout(std140) uniform MapViews {
    ViewData mapViews[kMaxViews];
};
#ifdef CUBE
uniform sampler2DArray mapReceiver;
#else
uniform sampler2D mapReceiver;
#endif
uniform sampler2D receiver;
uniform int mapCount;

layout(location = 0) out vec4 irradiance;

vec2 seenByMap(ivec2 texel, int face) {
#ifdef CUBE
    return texelFetch(mapReceiver, ivec3(texel, face), 0).xy;
#else
    return texelFetch(mapReceiver, texel, 0).xy;
#endif
}

void main() {
    irradiance = vec4(0.0);
    float depth = texelFetch(receiver, ivec2(gl_FragCoord.xy), 0).x;
    if (depth <= 0.0) return;
    vec3 positionVs = viewRay(gl_FragCoord.xy) * depth;
    for (int face = 0; face < mapCount; ++face) {
        ViewData map = mapViews[face];
        vec3 there = (map.fromEye * vec4(positionVs, 1.0)).xyz;
        if (-there.z <= map.frustum.z) continue;
#ifdef CUBE
        vec2 ndc = there.xy / (-there.z * map.frustum.xy);
#else
        vec2 ndc = there.xy / map.frustum.xy;
#endif
        ivec2 texel = ivec2(floor((ndc * 0.5 + 0.5) * map.sizePixels.xy));
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(map.sizePixels.xy))))
            continue;
        vec2 seen = seenByMap(texel, face);
        if (abs(seen.x + there.z) > 0.1 || seen.y <= 0.0) continue;
        irradiance.rgb = fluxAt(texel, kFluxPart, face) / seen.y;
        return;
    }
}
