// SPDX-License-Identifier: MIT
// Which probe each photon of a list comes from. PROBES_BEFORE: by what is known of the list before;
// else that list is the probes'. One thread a photon.
#include "include/photons/photon_thread.glsl"
#include "include/photons/photons.glsl"

#ifdef PROBES_BEFORE
layout(std430) readonly buffer ProbesBefore {
    uint probesBefore[];
};
#endif
layout(std430) writeonly buffer ProbeNumbers {
    uint probeNumbers[];
};

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    uint parent = originAt(ivec2(photonTexel(photons, index))).parent;
#ifdef PROBES_BEFORE
    parent = probesBefore[parent];
#endif
    probeNumbers[index] = parent;
}
