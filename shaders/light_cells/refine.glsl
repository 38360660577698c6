// SPDX-License-Identifier: MIT
// What becomes of a cell of a light's view, by its four probes (WN09, sections 3.2.1 and 3.2.2).
#include "light_cells/cell_lists.glsl"
#include "light_cells/mask.glsl"
#include "techniques/light_cells/landing_data.h"

layout(std430) readonly buffer TakenCells {
    LightCell takenCells[];
};
layout(std430) readonly buffer ProbeList {
    PhotonList probeList;
};
uniform sampler2D hitFlux;  // of the probes, on specular surfaces
#ifdef LANDINGS
layout(std430) readonly buffer Landings {
    Landing landings[];
};
uniform int branches;
uniform float tolerance;  // texels
#endif
uniform uint checkLevel;
uniform uint finestLevel;

// Bits 0 to 3: quarters that wait; 4 to 7: quarters that are photons; 8 to 11: quarters that one
// photon of the whole cell stands for.
uint waitingOf(uint decision) { return uint(bitCount(decision & 15u)); }
uint photonsOf(uint decision) {
    return uint(bitCount((decision >> 4u) & 15u)) + ((decision >> 8u & 15u) != 0u ? 1u : 0u);
}

bool isHit(uint probe) {
    return uint(texelFetch(hitFlux, ivec2(photonTexel(probeList, probe)), 0).w) == kFateSpecular;
}

#ifdef LANDINGS
// Whether these probes' light arrives so close together that one photon will do.
bool isTogether(uint first, uint quarters) {
    for (int branch = 0; branch < branches; ++branch) {
        vec4 low = vec4(3.0e38);
        vec4 high = vec4(-3.0e38);
        uint known = 0u;
        Landing one;
        for (uint i = 0u; i < 4u; ++i) {
            if ((quarters & (1u << i)) == 0u) continue;
            Landing landing = landings[(first + i) * uint(branches) + uint(branch)];
            if (known == 0u) one = landing;
            known = 1u;
            if (landing.seenBy != one.seenBy) return false;
#ifdef SIGNATURES
            if (landing.signature != one.signature) return false;
#endif
            low = min(low, landing.ends);
            high = max(high, landing.ends);
        }
        vec4 extent = high - low;
        float widest = max(max(extent.x, extent.y), max(extent.z, extent.w));
        if (known == 1u && one.seenBy != 0u && !(widest < tolerance))
            return false;
    }
    return true;
}
#endif

uint decisionOn(uint index) {
    LightCell cell = takenCells[index];
    uint first = 4u * index;
    uint level = cell.level + 1u;
    uint hit = 0u;
    uint held = 0u;  // that may hold something specular
    uint filled = 15u;  // that hold nothing else
    for (uint i = 0u; i < 4u; ++i) {
        if (isHit(first + i)) hit |= 1u << i;
#ifdef MASK
        uvec2 mask = maskOf(quarterOfCell(cell, i));
        if (mask.x != 0u) held |= 1u << i;
        if (mask.y == 0u) filled &= ~(1u << i);
#endif
    }
#ifdef MASK
    bool isKnown = isMasked(level);
#else
    bool isKnown = false;
#endif
    // As published: a cell of which no photon hits is dropped, else all four quarters are looked at.
    if (!isKnown) held = hit == 0u ? 0u : 15u;
    held |= hit;
    if (held == 0u) return 0u;
#ifdef LANDINGS
    // A quarter that is lit in part is known by its middle alone: it carries all of its light or none,
    // and the finer it is, the less that is off.
    if (level >= checkLevel && hit == held && (hit & filled) == hit && tolerance > 0.0 && isTogether(first, hit))
        return hit << 8u;
#endif
    return level >= finestLevel ? hit << 4u : held;
}

// For the report.
void noteDecision(uint index, uint decision) {
    bool isMerged = (decision >> 8u) != 0u;
    if (decision == 0u) atomicAdd(counting.discarded, 1u);
    if (isMerged) atomicAdd(counting.merged, 1u);
    if ((decision >> 4u) != 0u)
        atomicMax(counting.deepest, takenCells[index].level + (isMerged ? 0u : 1u));
}
