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
// event of its own account and adds nothing. Photons that another batch brings as well have flux
// that no sum resolves (emit/grid.comp), and count there.
void ledgerAdd(uint account, vec3 fluxWatts) {
    float watts = fluxWatts.r + fluxWatts.g + fluxWatts.b;
    if (isnan(watts) || isinf(watts) || watts < 0.0) {
        atomicAdd(ledger[kAccountNotANumber].events, 1u);
        return;
    }
    if (watts > 0.0 && watts * ledgerUnitsPerWatt < 0.25) return;
    // A float has 24 bits, so that both halves are exact.
    float units = floor(watts * ledgerUnitsPerWatt);
    float high = floor(units * (1.0 / 4294967296.0));
    ledgerAddUnits(account, uint(units - high * 4294967296.0), uint(high));
    atomicAdd(ledger[account].events, 1u);
}
