// SPDX-License-Identifier: MIT
// Hard cases of these nodes alone, and what all cases need to know of them.
#pragma once

#include "framework/numerics/suite.h"

namespace kaustik {

void addScreenSpacePhotonCases(numerics::Suite& suite);
void addViewCases(numerics::Suite& suite);    // what the eye sees through interfaces
void addNestedCases(numerics::Suite& suite);  // dielectrics in one another

}  // namespace kaustik
