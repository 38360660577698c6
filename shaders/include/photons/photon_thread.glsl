// SPDX-License-Identifier: MIT
// A compute thread a photon of a list: Command::dispatchOver(photons).
#include "include/photons/photons.glsl"

layout(local_size_x = 64) in;  // kPhotonGroup

uint workgroupNumber() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Not below photons.count where there is none for this thread.
uint photonOfThread() {
    return workgroupNumber() * kPhotonGroup + gl_LocalInvocationIndex;
}
