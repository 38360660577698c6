// SPDX-License-Identifier: MIT
// Photons that a batch of emission brings from rows next to its own (Samples::borderRows).

// They are there to be joined with, and carry of their flux a share that no sum of watts resolves,
// since none is more than 2^60 of its units; a power of two, so that what they would carry is known
// to the last bit. What is less than 2^-62 W is not.
const float kNegligible = exp2(-64.0);
