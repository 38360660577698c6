// SPDX-License-Identifier: MIT
// The next list of photons, to write, as Photons::store binds it under "next".
#include "include/photons/transfer_map.glsl"
#include "framework/transport/photon_list.h"
#ifdef PHOTON_BEAMS
#include "include/photons/beam.glsl"
#endif

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

#ifdef PHOTON_BEAMS
layout(rgba32f) writeonly uniform image2D nextBeamPlace;
layout(rgba32f) writeonly uniform image2D nextBeamTurn;

void storeNextBeam(uint slot, Beam beam) {
    ivec2 texel = ivec2(photonTexel(nextPhotons, slot));
    imageStore(nextBeamPlace, texel, beamPlaceTexel(beam));
    imageStore(nextBeamTurn, texel, beamTurnTexel(beam));
}
#endif
