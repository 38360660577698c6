// SPDX-License-Identifier: MIT
// What a run claims and no light can do. It is told as an error: whatever else such a run says is
// worth nothing.
#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/renderer.h"

namespace kaustik::report {

// The largest |balance| that rounding explains, of the emitted flux: a photon's flux is rounded to
// the ledger's unit, 2^-60 of a bound on all light, and to 32-bit floats on its way, 2^-24 of it at
// each interaction.
inline constexpr double kLargestBalance = 1e-5;

// A sentence each; none where all is well. `ledger`: of a whole frame of the renderer's settings.
// Where the tracer may hit with one photon more than once (TraceStage::Traits::multipliesLight), or
// passes that light goes through may be switched off, no balance is asked for.
[[nodiscard]] std::vector<std::string> violations(const EnergyLedger& ledger,
                                                  const Renderer& renderer);

}  // namespace kaustik::report
