// SPDX-License-Identifier: MIT
// A compute thread a photon of the list that a pass makes: Command::dispatchOver(photons), which
// knows already how many there will be.
#include "include/photons/store_photons.glsl"

layout(local_size_x = 64) in;  // kPhotonGroup

uint workgroupNumber() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

uint photonOfThread() {
    return workgroupNumber() * kPhotonGroup + gl_LocalInvocationIndex;
}
