// SPDX-License-Identifier: MIT
// How many photons of every workgroup's go on, since they have hit a specular surface.
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"

layout(std430) writeonly buffer NextFirsts {
    uint nextFirsts[];
};
shared uint continuingCount;

void main() {
    if (gl_LocalInvocationIndex == 0u) continuingCount = 0u;
    barrier();
    uint index = photonOfThread();
    if (index < photons.count) {
        float fate = texelFetch(hitFlux, ivec2(photonTexel(photons, index)), 0).w;
        if (uint(fate) == kFateSpecular) atomicAdd(continuingCount, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && workgroupNumber() * kPhotonGroup < photons.count)
        nextFirsts[workgroupNumber()] = continuingCount;
}
