// SPDX-License-Identifier: MIT
// The next list of photons, to write, as Photons::store binds it under "next".
#include "include/transfer_map.glsl"
#include "framework/transport/photon_list.h"

layout(rgba32f) writeonly uniform image2D nextPosition;
layout(rgba32f) writeonly uniform image2D nextDirection;
layout(rgba32f) writeonly uniform image2D nextFlux;
layout(rgba32ui) writeonly uniform uimage2D nextOrigin;
layout(std430) readonly buffer NextPhotons {
    PhotonList nextPhotons;
};

void storeNext(uint slot, Photon photon, PhotonOrigin origin) {
    ivec2 texel = ivec2(photonTexel(nextPhotons, slot));
    imageStore(nextPosition, texel, photonPositionTexel(photon));
    imageStore(nextDirection, texel, photonDirectionTexel(photon));
    imageStore(nextFlux, texel, photonFluxTexel(photon));
    imageStore(nextOrigin, texel, originTexel(origin));
}
