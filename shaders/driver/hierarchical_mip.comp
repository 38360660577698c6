// SPDX-License-Identifier: MIT
// A level of squares of cells from the four below each, and how many photons are stored of each
// square: one of a square that one will do for, else those of the squares below. Down from the top
// these counts are the places of all that is stored (Ziegler et al. 2006, HistoPyramids). One
// thread a square. FROM_PHOTONS: from the cells' own photons.
#include "driver/hierarchical.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform ivec2 size;  // of the level, squares
uniform ivec2 sizeBelow;
uniform int first;   // node of the level
uniform int grids;   // lights and branches
uniform int merges;  // 1: squares of this level may be one photon
uniform int tellsPaths;
uniform float tolerance;
#ifdef FROM_PHOTONS
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
                         photon, photon, landing.seenBy, tellsPaths == 1 ? landing.signature : 0u);
}
uint storedBelow(int at) { return cellPhotons[at] == 0u ? 0u : 1u; }
#else
uniform int firstBelow;
HierarchyNode below(int at) { return nodes[firstBelow + at]; }
uint storedBelow(int at) { return storedOf[firstBelow + at]; }
#endif

// With what another square holds.
HierarchyNode joined(HierarchyNode a, HierarchyNode b) {
    if (a.first == 0u) return b;
    if (b.first == 0u) return a;
    bool isOne = a.state == b.state && a.signature == b.signature;
    return HierarchyNode(min(a.low, b.low), max(a.high, b.high), a.flux + b.flux, a.first, a.middle,
                         isOne ? a.state : kMixed, a.signature);
}

void main() {
    ivec2 here = ivec2(gl_GlobalInvocationID.xy);
    int grid = here.y / size.y;
    here.y -= grid * size.y;
    if (here.x >= size.x || grid >= grids) return;
    HierarchyNode node = kNoNode;
    uint middle = 0u;
    uint stored = 0u;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = 2 * here + ivec2(i & 1, i >> 1);
        if (any(greaterThanEqual(child, sizeBelow))) continue;
        int at = (grid * sizeBelow.y + child.y) * sizeBelow.x + child.x;
        HierarchyNode part = below(at);
        node = joined(node, part);
        stored += storedBelow(at);
        // Its lower left corner is the middle of all four.
        if (i == 3) middle = part.first;
    }
    if (middle != 0u) node.middle = middle;
    int place = first + (grid * size.y + here.y) * size.x + here.x;
    nodes[place] = node;
    storedOf[place] = merges == 1 && isOnePhoton(node, tolerance) ? 1u : stored;
}
