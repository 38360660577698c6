// SPDX-License-Identifier: MIT
// A list of photons to read, as Photons::sample binds it.
#include "include/photons/transfer_map.glsl"
#include "include/surfaces/bands.glsl"
#include "framework/transport/photon_list.h"
#ifdef PHOTON_BEAMS
#include "include/photons/beam.glsl"
#endif

uniform sampler2D photonPosition;
uniform sampler2D photonDirection;
uniform sampler2D photonFlux;
uniform usampler2D photonOrigin;
layout(std430) readonly buffer Photons {
    PhotonList photons;
};

// Of a texel without a photon nothing else may be asked for (techniques/photon_lists/emitted.h).
uint fateAt(ivec2 texel) { return uint(texelFetch(photonDirection, texel, 0).w); }

// What colours do, and how much dielectrics bend, is what they do to this photon from here on.
Photon photonAt(ivec2 texel) {
    takeBandOf(texelFetch(photonOrigin, texel, 0).y & 0xffffu);
    return unpackPhoton(texelFetch(photonPosition, texel, 0), texelFetch(photonDirection, texel, 0),
                        texelFetch(photonFlux, texel, 0));
}

#ifdef PHOTON_BEAMS
uniform sampler2D photonBeamPlace;
uniform sampler2D photonBeamTurn;
#ifdef LIGHT_SPREAD
uniform sampler2D photonSpreadPlace;
uniform sampler2D photonSpreadTurn;
#endif

Beam beamAt(ivec2 texel) {
    Beam beam =
        unpackBeam(texelFetch(photonBeamPlace, texel, 0), texelFetch(photonBeamTurn, texel, 0));
#ifdef LIGHT_SPREAD
    Beam spread = unpackBeam(texelFetch(photonSpreadPlace, texel, 0),
                             texelFetch(photonSpreadTurn, texel, 0));
    beam.spreadPlace = spread.place;
    beam.spreadTurn = spread.turn;
#endif
    return beam;
}
#endif

PhotonOrigin originAt(ivec2 texel) {
    return unpackOrigin(texelFetch(photonOrigin, texel, 0));
}
