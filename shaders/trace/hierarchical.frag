// SPDX-License-Identifier: MIT
// trace.hierarchical: one fragment a photon, drawn over the transfer map.
#include "include/photons/photon_fragment.glsl"
#include "trace/hierarchical.glsl"

layout(location = 0) out vec4 hitPosition;
layout(location = 1) out vec4 hitSurface;
layout(location = 2) out vec4 hitFlux;
#ifdef PHOTON_BEAMS
layout(location = 3) out vec4 hitShape;
#endif

void main() {
    if (!isPhotonHere()) discard;
    Photon photon = photonAt(ivec2(gl_FragCoord.xy));
    Hit hit = emptyHit();
    FirstHit first = noHit();
    if (photon.fate == kFateInFlight) {
        first = traverse(photon, trace_hierarchical_minimum, trace_hierarchical_steps);
        hit = deliver(photon, first);
    }
    storeOrder(ivec2(gl_FragCoord.xy), photon, first, hit, uint(first.step) + 1u);
    hitPosition = hitPositionTexel(hit);
    hitSurface = hitSurfaceTexel(hit);
    hitFlux = hitFluxTexel(hit);
#ifdef PHOTON_BEAMS
    hitShape = vec4(hit.shape, 0.0);
#endif
}
