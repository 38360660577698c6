// SPDX-License-Identifier: MIT
// A compute thread a photon of a list: Command::dispatchOver(photons).
#include "include/photons/photons.glsl"
#include "include/thread.glsl"

// Not below photons.count where there is none for this thread.
uint photonOfThread() {
    return threadNumber();  // kPhotonGroup of them a workgroup
}
