// SPDX-License-Identifier: MIT
// The next list of photons, to write, as Photons::store binds it under "next"; store_beams.glsl
// writes their beams. Apart, since a program may declare no more than eight images.
#include "include/photons/next_photon_list.glsl"

layout(rgba32f) writeonly uniform image2D nextPosition;
layout(rgba32f) writeonly uniform image2D nextDirection;
layout(rgba32f) writeonly uniform image2D nextFlux;
layout(rgba32ui) writeonly uniform uimage2D nextOrigin;

void storeNext(uint slot, Photon photon, PhotonOrigin origin) {
    ivec2 texel = ivec2(photonTexel(nextPhotons, slot));
    imageStore(nextPosition, texel, photonPositionTexel(photon));
    imageStore(nextDirection, texel, photonDirectionTexel(photon));
    imageStore(nextFlux, texel, photonFluxTexel(photon));
    imageStore(nextOrigin, texel, originTexel(origin));
}
