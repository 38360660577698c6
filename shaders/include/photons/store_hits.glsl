// SPDX-License-Identifier: MIT
// Hits to write, as Hits::store binds them. HITS_WITHOUT_SHAPE: another shader of the pass adds that.
#include "include/photons/transfer_map.glsl"

layout(rgba32f) writeonly uniform image2D hitPosition;
layout(rgba32f) writeonly uniform image2D hitSurface;
layout(rgba32f) writeonly uniform image2D hitFlux;

#if defined(PHOTON_BEAMS) && !defined(HITS_WITHOUT_SHAPE)
layout(rgba32f) writeonly uniform image2D hitShape;
#endif

void storeHit(ivec2 texel, Hit hit) {
    imageStore(hitPosition, texel, hitPositionTexel(hit));
    imageStore(hitSurface, texel, hitSurfaceTexel(hit));
    imageStore(hitFlux, texel, hitFluxTexel(hit));
#if defined(PHOTON_BEAMS) && !defined(HITS_WITHOUT_SHAPE)
    imageStore(hitShape, texel, vec4(hit.shape, 0.0));
#endif
}
