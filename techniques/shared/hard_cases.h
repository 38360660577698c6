// SPDX-License-Identifier: MIT
// Hard cases of the shared nodes alone.
#pragma once

#include "framework/numerics/suite.h"

namespace kaustik {

void addSharedCases(numerics::Suite& suite);

}  // namespace kaustik
