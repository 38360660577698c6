// SPDX-License-Identifier: MIT
#pragma once

#include "framework/numerics/suite.h"

namespace kaustik {

// Caustic triangles on the faces of a cube (33) and the secant search (35).
void addCausticTrianglesCases(numerics::Suite& suite);

}  // namespace kaustik
