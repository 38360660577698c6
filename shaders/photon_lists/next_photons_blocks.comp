// SPDX-License-Identifier: MIT
// How many photons every workgroup's send on, since they have hit a specular surface. BRANCHES: two
// where light parts and there is room for both, which is noted bit by bit, so that who sends them on
// does as has been counted.
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"
#ifdef BRANCHES
#include "include/photons/branches.glsl"

layout(std430) writeonly buffer NextParting {
    uvec2 nextParting[];
};
shared uint partingBits[2];
#endif

layout(std430) writeonly buffer NextFirsts {
    uint nextFirsts[];
};
shared uint continuingCount;

void main() {
    uint local = gl_LocalInvocationIndex;
    if (local == 0u) continuingCount = 0u;
#ifdef BRANCHES
    if (local < 2u) partingBits[local] = 0u;
#endif
    barrier();
    uint index = photonOfThread();
    if (index < photons.count) {
        ivec2 texel = ivec2(photonTexel(photons, index));
        if (uint(texelFetch(hitFlux, texel, 0).w) == kFateSpecular) {
            uint count = 1u;
#ifdef BRANCHES
            if (branchRoomOf(originAt(texel)) > 1u && partsLight(photonAt(texel), hitAt(texel))) {
                atomicOr(partingBits[local >> 5u], 1u << (local & 31u));
                count = 2u;
            }
#endif
            atomicAdd(continuingCount, count);
        }
    }
    barrier();
    if (local != 0u || workgroupNumber() * kPhotonGroup >= photons.count) return;
    nextFirsts[workgroupNumber()] = continuingCount;
#ifdef BRANCHES
    nextParting[workgroupNumber()] = uvec2(partingBits[0], partingBits[1]);
#endif
}
