// SPDX-License-Identifier: MIT
// The ledger of a compute shader whose threads would all add to the same few words: a workgroup adds
// up in its own memory, and then once to each account. The sums are integers, so the same to the bit.
// To be included before anything else; the shader has threadMain() in place of main().
#define LEDGER_OF_GROUP
#include "include/photons/ledger.glsl"

void threadMain();

#ifdef NO_LEDGER
void main() { threadMain(); }
#else
// Workgroups have 64 threads, more than the ledger has entries.
void main() {
    uint account = gl_LocalInvocationIndex;
    if (account < kLedgerEntryCount) groupLedger[account] = LedgerEntry(0u, 0u, 0u, 0u);
    barrier();
    threadMain();
    barrier();
    if (account >= kLedgerEntryCount) return;
    LedgerEntry sum = groupLedger[account];
    if ((sum.low | sum.high) != 0u) ledgerAddToDevice(account, sum.low, sum.high);
    if (sum.events > 0u) atomicAdd(ledger[account].events, sum.events);
}
#endif
