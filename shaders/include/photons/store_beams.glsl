// SPDX-License-Identifier: MIT
// The beams of the next list of photons, to write, as Photons::store binds them under "next".
#include "include/photons/next_photon_list.glsl"
#ifdef PHOTON_BEAMS
#include "include/photons/beam.glsl"

layout(rgba32f) writeonly uniform image2D nextBeamPlace;
layout(rgba32f) writeonly uniform image2D nextBeamTurn;
#ifdef LIGHT_SPREAD
layout(rgba32f) writeonly uniform image2D nextSpreadPlace;
layout(rgba32f) writeonly uniform image2D nextSpreadTurn;
#endif

void storeNextBeam(uint slot, Beam beam) {
    ivec2 texel = ivec2(photonTexel(nextPhotons, slot));
    imageStore(nextBeamPlace, texel, beamPlaceTexel(beam));
    imageStore(nextBeamTurn, texel, beamTurnTexel(beam));
#ifdef LIGHT_SPREAD
    imageStore(nextSpreadPlace, texel, beamPlaceTexel(spreadOf(beam)));
    imageStore(nextSpreadTurn, texel, beamTurnTexel(spreadOf(beam)));
#endif
}
#endif
