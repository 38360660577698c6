// SPDX-License-Identifier: MIT
// A compute thread a photon of the list that a pass makes: Command::dispatchOver(photons), which
// knows already how many there will be.
#include "include/photons/next_photon_list.glsl"
#include "include/thread.glsl"

uint photonOfThread() {
    return threadNumber();  // kPhotonGroup of them a workgroup
}
