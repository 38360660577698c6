// SPDX-License-Identifier: MIT
// Which hits of a list a map takes. ONE_LIGHT: those of one light's photons.
#include "include/hits.glsl"
#include "include/photon_thread.glsl"

#ifdef ONE_LIGHT
uniform int lightOfMap;
#endif

bool arrivesHere(ivec2 texel) {
    bool isOurs = true;
#ifdef ONE_LIGHT
    isOurs = int(originAt(texel).light) == lightOfMap;
#endif
    return isOurs && uint(texelFetch(hitFlux, texel, 0).w) == kFateReceiver;
}
