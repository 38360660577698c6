// SPDX-License-Identifier: MIT
// Nothing of a round's probes has landed yet. One thread a probe.
#include "include/thread.glsl"
#include "framework/transport/photon_list.h"
#include "techniques/light_cells/landing_data.h"

layout(std430) readonly buffer ProbeList {
    PhotonList probeList;
};
layout(std430) writeonly buffer Landings {
    Landing landings[];
};
uniform uint branches;  // entries of a probe

void main() {
    uint index = threadNumber();
    if (index >= probeList.count) return;
    for (uint entry = index * branches; entry < (index + 1u) * branches; ++entry)
        landings[entry] = Landing(vec4(0.0), 0u, 0u, 0u, 0u);
}
