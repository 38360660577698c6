// SPDX-License-Identifier: MIT
// Counts what is as wide as a bound allows, and not as its photon's beam asks (splats/clamped.h).
#include "include/photons/ledger_unit.glsl"
#include "framework/transport/types.h"

layout(std430) buffer ClampedWidths {
    Clamped clamped[];
};

// `factor`: by which its width differs, above 1; `fluxWatts`: what it carries.
void countClamped(uint which, float factor, vec3 fluxWatts) {
    float watts = fluxWatts.r + fluxWatts.g + fluxWatts.b;
    if (!(watts >= 0.0) || isOfOtherBatch(watts)) return;
    uvec2 units = unitsOfWatts(watts);
    uint before = atomicAdd(clamped[which].lowUnits, units.x);
    uint high = units.y + (before > 0xffffffffu - units.x ? 1u : 0u);
    if (high > 0u) atomicAdd(clamped[which].highUnits, high);
    atomicAdd(clamped[which].count, 1u);
    atomicMax(clamped[which].factorBits, floatBitsToUint(min(factor, 1e30)));
}
