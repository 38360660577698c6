// SPDX-License-Identifier: MIT
// Radiance of the receivers on the straight eye rays, W/m²/sr: direct light, the caustic and the
// fill light; the environment where there is no receiver. GLOSSY_RECEIVERS: direct light
// has gone through the BRDF already; CAUSTIC_RADIANCE: so has the caustic; EMISSION: some material
// emits. All else is reflected
// diffusely.
#include "include/surfaces/environment.glsl"
#if defined(GLOSSY_RECEIVERS) || defined(EMISSION)
#include "include/surfaces/surface_data.glsl"
#endif

layout(location = 0) out vec4 radiance;

uniform sampler2D receiverAlbedo;
#if defined(GLOSSY_RECEIVERS) || defined(EMISSION)
uniform sampler2D receiverSurface;
#endif
#ifdef GLOSSY_RECEIVERS
uniform sampler2D directRadiance;
#else
uniform sampler2D directIrradiance;
#endif
#ifdef CAUSTIC_RADIANCE
uniform sampler2D causticRadiance;
#else
uniform sampler2D causticIrradiance;
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 reflectance = texelFetch(receiverAlbedo, pixel, 0);
    if (reflectance.a <= 0.0) {  // there is no receiver
        radiance = vec4(environmentRadiance(normalize(viewRay(gl_FragCoord.xy))), 1.0);
        return;
    }
    vec3 albedo = reflectance.rgb * (1.0 / 3.14159265);
    vec3 fill = albedo * view.ambient.rgb;
#ifdef GLOSSY_RECEIVERS
    // Light from everywhere: the whole of the lobe reflects it.
    uint material = uint(texelFetch(receiverSurface, pixel, 0).w) - 1u;
    fill += materials[material].specular.rgb * (1.0 / 3.14159265) * view.ambient.rgb;
    vec3 direct = texelFetch(directRadiance, pixel, 0).rgb;
#else
    vec3 direct = albedo * texelFetch(directIrradiance, pixel, 0).rgb;
#endif
#ifdef CAUSTIC_RADIANCE
    vec3 caustic = texelFetch(causticRadiance, pixel, 0).rgb;
#else
    vec3 caustic = albedo * texelFetch(causticIrradiance, pixel, 0).rgb;
#endif
    radiance.rgb = direct + caustic + fill;
#ifdef EMISSION
    // A lamp shines from its front.
    vec4 surface = texelFetch(receiverSurface, pixel, 0);
    if (dot(surface.xyz, viewRay(gl_FragCoord.xy)) < 0.0)
        radiance.rgb += materials[uint(surface.w) - 1u].emission.rgb;
#endif
}
