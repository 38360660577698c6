// SPDX-License-Identifier: MIT
// Squares of cells whose photons arrive together (W08). A level's squares lie row by row, for one
// light and branch after the other; the last level has one square of each.
#include "framework/transport/photon_list.h"
#include "framework/transport/types.h"

struct HierarchyNode {
    vec2 low;        // where its photons arrive, texels
    vec2 high;
    vec4 flux;       // their sum, W; w: how many there are
    uint first;      // photon + 1; 0: none
    uint middle;     // the one nearest to the square's middle
    uint state;      // Landing::seenBy of all, or kMixed
    uint signature;  // of all
};
const uint kMixed = 0xffffffffu;
// A photon of the list that arrived, and the square that it stands for.
struct StoredPhoton {
    uint photon;
    uint node;   // + 1; 0: for itself
    uint level;  // of the square
};

layout(std430) buffer HierarchyNodes {
    HierarchyNode nodes[];
};
// How many photons are stored of each square.
layout(std430) buffer HierarchyStored {
    uint storedOf[];
};

const HierarchyNode kNoNode = HierarchyNode(vec2(3.0e38), vec2(-3.0e38), vec4(0.0), 0u, 0u, 0u, 0u);

// Whether one photon will do; none of what no view sees.
bool isOnePhoton(HierarchyNode node, float tolerance) {
    vec2 extent = node.high - node.low;
    return node.state != kMixed && node.state != 0u && node.flux.w > 1.0 &&
           max(extent.x, extent.y) < tolerance;
}
