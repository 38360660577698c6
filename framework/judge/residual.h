// SPDX-License-Identifier: MIT
// What is left of their picture by the last fit, and in which pixels it is significant.
#pragma once

#include "framework/judge/class_verdicts.h"

namespace kaustik::judge {

// Sets the verdict's residual, z, and what is counted of them.
void setResidual(const Comparison& comparison, const LinearFit& fitted, const Exposure& exposure,
                 Verdict& verdict);

}  // namespace kaustik::judge
