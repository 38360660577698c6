// SPDX-License-Identifier: MIT
// Which hits of a list a map takes. ONE_LIGHT: those of one light's photons; ONE_GENERATOR: of those
// that have left one caustic generator last.
#include "include/hits.glsl"
#include "include/photon_thread.glsl"

#ifdef ONE_LIGHT
uniform int lightOfMap;
#endif
#ifdef ONE_GENERATOR
#include "include/generators.glsl"
uniform int generatorOfMap;
#endif

bool arrivesHere(ivec2 texel) {
    bool isOurs = true;
#ifdef ONE_LIGHT
    isOurs = int(originAt(texel).light) == lightOfMap;
#endif
#ifdef ONE_GENERATOR
    isOurs = generatorOf(texelFetch(photonPosition, texel, 0).xyz) == generatorOfMap;
#endif
    return isOurs && uint(texelFetch(hitFlux, texel, 0).w) == kFateReceiver;
}
