// SPDX-License-Identifier: MIT
// A list of photons to read, as Photons::sample binds it.
#include "include/transfer_map.glsl"
#include "framework/transport/photon_list.h"

uniform sampler2D photonPosition;
uniform sampler2D photonDirection;
uniform sampler2D photonFlux;
uniform usampler2D photonOrigin;
layout(std430) readonly buffer Photons {
    PhotonList photons;
};

Photon photonAt(ivec2 texel) {
    return unpackPhoton(texelFetch(photonPosition, texel, 0), texelFetch(photonDirection, texel, 0),
                        texelFetch(photonFlux, texel, 0));
}

PhotonOrigin originAt(ivec2 texel) {
    return unpackOrigin(texelFetch(photonOrigin, texel, 0));
}
