// SPDX-License-Identifier: MIT
// The energy ledger: sums of watts in 64-bit fixed point by integer atomics, so that they neither
// drift nor depend on the order in which photons come.
#include "include/photons/ledger_unit.glsl"
#include "framework/transport/types.h"

layout(std430) buffer LedgerEntries {
    LedgerEntry ledger[];
};

// Adds units, as two words, to an account.
void ledgerAddUnits(uint account, uint lowUnits, uint highUnits) {
    uint before = atomicAdd(ledger[account].low, lowUnits);
    uint high = highUnits + (before > 0xffffffffu - lowUnits ? 1u : 0u);
    if (high > 0u) atomicAdd(ledger[account].high, high);
}

// Adds the flux of all channels to an account, as one event. What is not a number counts as an
// event of its own account and adds nothing; nothing is no event but there.
void ledgerAdd(uint account, vec3 fluxWatts) {
    float watts = fluxWatts.r + fluxWatts.g + fluxWatts.b;
    if (isnan(watts) || isinf(watts) || watts < 0.0) {
        atomicAdd(ledger[kAccountNotANumber].events, 1u);
        return;
    }
    if (watts == 0.0 && account != kAccountNotANumber) return;
    if (isOfOtherBatch(watts)) return;
    uvec2 units = unitsOfWatts(watts);
    ledgerAddUnits(account, units.x, units.y);
    atomicAdd(ledger[account].events, 1u);
}
