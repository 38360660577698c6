// SPDX-License-Identifier: MIT
// What the techniques add to the suite of hard cases; only who measures them needs it.
#pragma once

#include "framework/numerics/suite.h"

namespace kaustik {

// The cases of the techniques' own nodes.
void registerHardCases(numerics::Suite& suite);

}  // namespace kaustik
