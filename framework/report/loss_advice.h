// SPDX-License-Identifier: MIT
// What a run has lost to one of its nodes' ways of looking at a scene, and which settings look
// otherwise.
#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/renderer.h"

namespace kaustik::report {

// Of the emitted flux, what may be in such an account before a run says so.
inline constexpr double kLossWithoutAWord = 0.03;

// A sentence each that names the account and what to take; none where all is well. `ledger`: of a
// whole frame of the renderer's settings.
[[nodiscard]] std::vector<std::string> lossAdvice(const EnergyLedger& ledger,
                                                  const Renderer& renderer);

}  // namespace kaustik::report
