// SPDX-License-Identifier: MIT
// Which hits of a list a map takes. ONE_LIGHT: those of one light's photons; ONE_GENERATOR: of those
// that have left one caustic generator last.
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/surfaces/bands.glsl"

#ifdef ONE_LIGHT
uniform int lightOfMap;
#endif
#ifdef ONE_GENERATOR
#include "include/surfaces/generators.glsl"
uniform int generatorOfMap;
#endif

// Whichever generator it has left.
bool hasArrivedFromAny(ivec2 texel) {
#ifdef ONE_LIGHT
    if (int(lightOfBand(originAt(texel).light)) != lightOfMap) return false;
#endif
    return uint(texelFetch(hitFlux, texel, 0).w) == kFateReceiver;
}

bool hasArrived(ivec2 texel) {
    bool isOwn = true;
#ifdef ONE_GENERATOR
    isOwn = generatorOf(texelFetch(photonPosition, texel, 0).xyz) == generatorOfMap;
#endif
    return isOwn && hasArrivedFromAny(texel);
}

// Which share of a photon's light the map takes that reconstructions can divide: several maps may
// have a part each.
float arrivedShare(ivec2 texel) {
    if (!hasArrivedFromAny(texel)) return 0.0;
#ifdef ONE_GENERATOR
    return shareOfGenerator(texelFetch(photonPosition, texel, 0).xyz, generatorOfMap);
#else
    return 1.0;
#endif
}
