// SPDX-License-Identifier: MIT
// How far two frames of one mixture are apart.
#pragma once

#include <string>

#include "tests/mixtures/bench.h"

namespace kaustik::mixtures {

// "" where all outputs and the ledger are the same bits.
[[nodiscard]] std::string differenceInBits(const Shot& one, const Shot& other);
// "" where no value of an output is farther from the other's, times `factor`, than `tolerance` of
// that output's largest, and no account of the ledger than `tolerance` of what was emitted, times
// `fluxFactor`.
[[nodiscard]] std::string differenceInValues(const Shot& one, const Shot& other, double factor,
                                             double fluxFactor, double tolerance);
// "" where the outputs differ by no more than `energy` in all, and by no more than `blocks` on
// average over squares of 10 x 10 pixels, as shares of the whole.
[[nodiscard]] std::string differenceInBlocks(const Shot& one, const Shot& other, double energy,
                                             double blocks);

}  // namespace kaustik::mixtures
