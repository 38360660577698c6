// SPDX-License-Identifier: MIT
// Direct irradiance of one light at the receivers, W/m². Every specular object blocks it wholly:
// what passes through arrives as caustic light (framework/README.md, "Outputs"). Where a receiver
// is glossy, also what of it goes to the eye, W/m²/sr.
#include "include/photons/lights.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/views/view.glsl"
#ifdef GLOSSY_RECEIVERS
#include "include/surfaces/receiver_brdf.glsl"
#endif

layout(location = 0) out vec4 irradiance;
#ifdef GLOSSY_RECEIVERS
layout(location = 1) out vec4 radiance;
#endif

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform sampler2DArray visibility;
uniform int lightIndex;

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
    irradiance.rgb = lightIrradiance(light, positionVs) * cosine *
                     texelFetch(visibility, ivec3(pixel, lightIndex), 0).x;
#ifdef GLOSSY_RECEIVERS
    radiance.rgb = irradiance.rgb * receiverReflection(pixel, surface, -direction);
#endif
}
