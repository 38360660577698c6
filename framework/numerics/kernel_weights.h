// SPDX-License-Identifier: MIT
// D31 for one reconstruction with one choice of settings: for cases of a technique's own kernels.
#pragma once

#include "framework/numerics/lab.h"

namespace kaustik::numerics {

// Rows that say that each of 100 photons, at another offset within its pixel, deposits its flux:
// for beams from far below a pixel to more than one. `what` names the settings, "" for the
// defaults.
void expectKernelWeights(Lab& lab, const Lab::Choice& reconstruct, const Settings& settings,
                         const std::string& what);

}  // namespace kaustik::numerics
