// SPDX-License-Identifier: MIT
// Hard cases that concern single nodes; those of whole stages are in framework/numerics/cases. A
// function is in the file of its node's name, techniques/STAGE/NODE_cases.cpp.
#pragma once

#include "framework/numerics/suite.h"

namespace kaustik {

void addGridCases(numerics::Suite& suite);
void addDenseCases(numerics::Suite& suite);
void addSpritesCases(numerics::Suite& suite);
void addRefractionCases(numerics::Suite& suite);  // and of the other nodes that follow eye rays
void addNestedCases(numerics::Suite& suite);      // dielectrics in one another
void addTrianglesCases(numerics::Suite& suite);
void addSecantCases(numerics::Suite& suite);

// Registers all cases of the nodes above.
void registerHardCases(numerics::Suite& suite);

}  // namespace kaustik
