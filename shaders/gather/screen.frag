// SPDX-License-Identifier: MIT
// Flux over the area that a pixel sees of its receiver.
//   HAS_INTENSITY  and what of it goes to the eye
//   HAS_DIRECTION  and where it comes from
// What both branches include is included before them: each file is so once.
#include "include/photons/ledger_unit.glsl"
#include "include/surfaces/bands.glsl"
#include "framework/transport/types.h"
#ifdef IS_FILTERED
uniform sampler2DArray filteredFlux;
#else
#include "include/maps/flux_sum_read.glsl"
#endif
#ifdef HAS_DIRECTION
#include "include/maps/long_directions.glsl"
#include "include/maps/mean_direction.glsl"
#include "include/surfaces/receiver_brdf.glsl"
uniform sampler2D receiverSurface;
#endif

uniform sampler2D receiver;

// 0: W; 1: W/sr towards the eye, or W times 1 + a direction.
vec3 storedAt(ivec2 pixel, int set) {
#ifdef IS_FILTERED
    return texelFetch(filteredFlux, ivec3(pixel, set), 0).rgb;
#else
    return fluxAt(pixel, set == 0 ? kFluxPart : kIntensityPart);
#endif
}

layout(location = 0) out vec4 irradiance;
#if defined(HAS_INTENSITY) || defined(HAS_DIRECTION)
layout(location = 1) out vec4 radiance;
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float area = texelFetch(receiver, pixel, 0).y;
    float overArea = area > 0.0 ? 1.0 / area : 0.0;
    vec3 flux = storedAt(pixel, 0);
    irradiance = vec4(rec709OfFlux(flux) * overArea, 0.0);
#ifdef HAS_INTENSITY
    radiance = vec4(rec709OfFlux(storedAt(pixel, 1)) * overArea, 0.0);
#endif
#ifdef HAS_DIRECTION
    radiance = vec4(0.0);
    MeanDirection mean = meanDirectionOf(flux, storedAt(pixel, 1));
    if (mean.resultant <= 0.0 || area <= 0.0) return;
    checkDirection(mean.resultant, flux.r + flux.g + flux.b);
    vec4 surface = texelFetch(receiverSurface, pixel, 0);
    radiance =
        vec4(irradiance.rgb * meanReflection(pixel, surface, mean.towards, mean.resultant), 0.0);
#endif
}
