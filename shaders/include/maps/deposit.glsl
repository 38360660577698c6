// SPDX-License-Identifier: MIT
// What reconstructions add to a texel of a map (techniques/stores/stores.h): flux, and where a
// receiver of the scene is glossy, what its irradiance alone does not tell.
//   GLOSSY_RECEIVERS  how it goes to the eye, W/sr: the map is of the eye's own pixels
//   MEAN_DIRECTION    the flux of all channels times 1 + its direction, which is nowhere negative
#include "include/maps/flux_sum.glsl"
#include "include/surfaces/bands.glsl"
#include "include/views/view.glsl"
#ifdef GLOSSY_RECEIVERS
#include "include/surfaces/receiver_brdf.glsl"
#endif

// To the set of the map that holds it. `texel`: of that, which of intensity is the eye's pixel;
// `directionVs`: unit, in which it arrives, in the eye's view.
void depositGlossy(ivec2 texel, int set, vec3 flux, vec3 directionVs) {
#ifdef GLOSSY_RECEIVERS
    vec4 surface = texelFetch(receiverSurface, texel, 0);
    vec3 intensity = reflectedFlux(flux, receiverReflection(texel, surface, -directionVs));
    sumAdd(texel, set, intensity * (ledgerUnitsPerWatt / kIntensityQuantum));
#endif
#ifdef MEAN_DIRECTION
    sumAdd(texel, set, (flux.r + flux.g + flux.b) * ledgerUnitsPerWatt * (1.0 + directionVs));
#endif
}

// To a map with one set of flux.
void depositFlux(ivec2 texel, vec3 flux, vec3 directionVs) {
#if defined(GLOSSY_RECEIVERS) || defined(MEAN_DIRECTION)
    int set = 2 * viewIndex;
    depositGlossy(texel, set + 1, flux, directionVs);
#else
    int set = viewIndex;
#endif
    sumAdd(texel, set, flux * ledgerUnitsPerWatt);
}
