// SPDX-License-Identifier: MIT
// Hits to write, as Hits::store binds them.
#include "include/transfer_map.glsl"

layout(rgba32f) writeonly uniform image2D hitPosition;
layout(rgba32f) writeonly uniform image2D hitSurface;
layout(rgba32f) writeonly uniform image2D hitFlux;

#ifdef PHOTON_BEAMS
layout(rgba32f) writeonly uniform image2D hitShape;
#endif

void storeHit(ivec2 texel, Hit hit) {
    imageStore(hitPosition, texel, hitPositionTexel(hit));
    imageStore(hitSurface, texel, hitSurfaceTexel(hit));
    imageStore(hitFlux, texel, hitFluxTexel(hit));
#ifdef PHOTON_BEAMS
    imageStore(hitShape, texel, vec4(hit.shape, 0.0));
#endif
}
