// SPDX-License-Identifier: MIT
// Hits to read, as Hits::sample binds them.
#include "include/photons/transfer_map.glsl"

uniform sampler2D hitPosition;
uniform sampler2D hitSurface;
uniform sampler2D hitFlux;

#ifdef PHOTON_BEAMS
uniform sampler2D hitShape;
#endif

Hit hitAt(ivec2 texel) {
    Hit hit = unpackHit(texelFetch(hitPosition, texel, 0), texelFetch(hitSurface, texel, 0),
                        texelFetch(hitFlux, texel, 0));
#ifdef PHOTON_BEAMS
    hit.shape = texelFetch(hitShape, texel, 0).xyz;
#endif
    return hit;
}
