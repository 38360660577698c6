// SPDX-License-Identifier: MIT
// Which hits of a list a map takes. ONE_LIGHT: those of one light's photons; ONE_GENERATOR: of those
// that have left one caustic generator last.
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"

#ifdef ONE_LIGHT
uniform int lightOfMap;
#endif
#ifdef ONE_GENERATOR
#include "include/surfaces/generators.glsl"
uniform int generatorOfMap;
#endif

bool hasArrived(ivec2 texel) {
    bool isOwn = true;
#ifdef ONE_LIGHT
    isOwn = int(originAt(texel).light) == lightOfMap;
#endif
#ifdef ONE_GENERATOR
    isOwn = generatorOf(texelFetch(photonPosition, texel, 0).xyz) == generatorOfMap;
#endif
    return isOwn && uint(texelFetch(hitFlux, texel, 0).w) == kFateReceiver;
}
