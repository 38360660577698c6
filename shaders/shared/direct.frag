// SPDX-License-Identifier: MIT
// Direct irradiance of one light at the receivers, W/m². Every specular object blocks it wholly: what
// passes through arrives as caustic light (design, section 1). Where a receiver is glossy, also what
// of it goes to the eye, W/m²/sr.
#include "common/lights.glsl"
#include "common/surface_data.glsl"
#include "common/view.glsl"
#ifdef GLOSSY_RECEIVERS
#include "common/receiver_brdf.glsl"
#endif

layout(location = 0) out vec4 irradiance;
#ifdef GLOSSY_RECEIVERS
layout(location = 1) out vec4 radiance;
#endif

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform sampler2DArray shadowMap;
uniform int lightIndex;
uniform int firstLayer;
uniform int faceCount;
uniform mat4 eyeToLight[6];
uniform mat4 projection;

// Share of the light that reaches the point: the mean of 3x3 comparisons.
float visibility(vec3 positionVs) {
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
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    irradiance = vec4(0.0);
#ifdef GLOSSY_RECEIVERS
    radiance = vec4(0.0);
#endif
    float depth = texelFetch(receiver, pixel, 0).x;
    if (depth <= 0.0) return;
    vec3 positionVs = viewRay(gl_FragCoord.xy) * depth;
    vec4 surface = texelFetch(receiverSurface, pixel, 0);
    LightData light = lights[lightIndex];
    vec3 direction = lightDirection(light, positionVs);
    // A sheet is lit on the side that the eye looks at, or not at all.
    bool isTurned = isOpen(uint(surface.w) - 1u) && dot(surface.xyz, positionVs) > 0.0;
    float cosine = -dot(isTurned ? -surface.xyz : surface.xyz, direction);
    if (cosine <= 0.0) return;
    irradiance.rgb = lightIrradiance(light, positionVs) * cosine * visibility(positionVs);
#ifdef GLOSSY_RECEIVERS
    radiance.rgb = irradiance.rgb * receiverReflection(pixel, surface, -direction);
#endif
}
