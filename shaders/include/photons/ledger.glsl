// SPDX-License-Identifier: MIT
// The energy ledger: sums of watts in 64-bit fixed point by integer atomics, so that they neither
// drift nor depend on the order in which photons come. A compute shader whose threads add to few
// accounts includes ledger_of_group.glsl in its place.
//   NO_LEDGER  of frames that are timed without it: nothing is added up
#include "include/photons/ledger_unit.glsl"
#include "framework/transport/primitives.h"

#ifdef NO_LEDGER
void ledgerAddUnits(uint account, uint lowUnits, uint highUnits) {}
void ledgerAddEvent(uint account) {}
void ledgerCountTraced(uint count) {}
#else
layout(std430) buffer LedgerEntries {
    LedgerEntry ledger[];
};

void ledgerAddToDevice(uint account, uint lowUnits, uint highUnits) {
    uint before = atomicAdd(ledger[account].low, lowUnits);
    uint high = highUnits + (before > 0xffffffffu - lowUnits ? 1u : 0u);
    if (high > 0u) atomicAdd(ledger[account].high, high);
}

#ifdef LEDGER_OF_GROUP
shared LedgerEntry groupLedger[kLedgerEntryCount];

// Adds units, as two words, to an account.
void ledgerAddUnits(uint account, uint lowUnits, uint highUnits) {
    uint before = atomicAdd(groupLedger[account].low, lowUnits);
    uint high = highUnits + (before > 0xffffffffu - lowUnits ? 1u : 0u);
    if (high > 0u) atomicAdd(groupLedger[account].high, high);
}
void ledgerAddEvent(uint account) { atomicAdd(groupLedger[account].events, 1u); }
#else
void ledgerAddUnits(uint account, uint lowUnits, uint highUnits) {
    ledgerAddToDevice(account, lowUnits, highUnits);
}
void ledgerAddEvent(uint account) { atomicAdd(ledger[account].events, 1u); }
#endif

// Photons that are sent on.
void ledgerCountTraced(uint count) { atomicAdd(ledger[kAccountEmitted].traced, count); }
#endif  // NO_LEDGER

// Adds the flux of all channels to an account, as one event. What is not a number counts as an
// event of its own account and adds nothing; nothing is no event but there.
void ledgerAdd(uint account, vec3 fluxWatts) {
    float watts = fluxWatts.r + fluxWatts.g + fluxWatts.b;
    if (isnan(watts) || isinf(watts) || watts < 0.0) {
        ledgerAddEvent(kAccountNotANumber);
        return;
    }
    if (watts == 0.0 && account != kAccountNotANumber) return;
    if (isOfOtherBatch(watts)) return;
    uvec2 units = unitsOfWatts(watts);
    ledgerAddUnits(account, units.x, units.y);
    ledgerAddEvent(account);
}
