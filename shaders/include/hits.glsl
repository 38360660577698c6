// SPDX-License-Identifier: MIT
// Hits to read, as Hits::sample binds them.
#include "include/transfer_map.glsl"

uniform sampler2D hitPosition;
uniform sampler2D hitSurface;
uniform sampler2D hitFlux;

Hit hitAt(ivec2 texel) {
    return unpackHit(texelFetch(hitPosition, texel, 0), texelFetch(hitSurface, texel, 0),
                     texelFetch(hitFlux, texel, 0));
}
