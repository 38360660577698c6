// SPDX-License-Identifier: MIT
// Photons that a batch of emission brings from rows next to its own (NodeDescription::joinsCells).

// They are there to be joined with, and carry of their flux a share below what any sum resolves; a
// power of two, so that all ratios are the same.
const float kNegligible = exp2(-80.0);
