// SPDX-License-Identifier: MIT
// A level of squares of cells from the four below each. One thread a square. FROM_PHOTONS: from the
// cells' own photons.
#include "driver/hierarchical.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform ivec2 size;  // of the level, squares
uniform ivec2 sizeBelow;
uniform int first;   // node of the level
uniform int grids;   // lights and branches
#ifdef FROM_PHOTONS
#include "framework/transport/photon_list.h"
#include "include/photons/hits.glsl"
#include "techniques/light_cells/landing_data.h"
layout(std430) readonly buffer CellPhotons {
    uint cellPhotons[];
};
layout(std430) readonly buffer Landings {
    Landing landings[];
};
layout(std430) readonly buffer Photons {
    PhotonList photons;
};

HierarchyNode below(int at) {
    uint photon = cellPhotons[at];
    if (photon == 0u) return kNoNode;
    Landing landing = landings[photon - 1u];
    ivec2 texel = ivec2(photonTexel(photons, photon - 1u));
    return HierarchyNode(landing.ends.xy, landing.ends.xy, vec4(texelFetch(hitFlux, texel, 0).rgb, 1.0),
                         photon, photon, landing.seenBy, landing.signature);
}
#else
uniform int firstBelow;
HierarchyNode below(int at) { return nodes[firstBelow + at]; }
#endif

void main() {
    ivec2 here = ivec2(gl_GlobalInvocationID.xy);
    int grid = here.y / size.y;
    here.y -= grid * size.y;
    if (here.x >= size.x || grid >= grids) return;
    HierarchyNode node = kNoNode;
    uint middle = 0u;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = 2 * here + ivec2(i & 1, i >> 1);
        if (any(greaterThanEqual(child, sizeBelow))) continue;
        HierarchyNode part = below((grid * sizeBelow.y + child.y) * sizeBelow.x + child.x);
        node = joined(node, part);
        // Its lower left corner is the middle of all four.
        if (i == 3) middle = part.first;
    }
    if (middle != 0u) node.middle = middle;
    nodes[first + (grid * size.y + here.y) * size.x + here.x] = node;
}
