// SPDX-License-Identifier: MIT
#include "techniques/register_hard_cases.h"

namespace kaustik {

void registerHardCases(numerics::Suite& suite) {
    addGridCases(suite);
    addDenseCases(suite);
    addSpritesCases(suite);
    addRefractionCases(suite);
    addNestedCases(suite);
    addTrianglesCases(suite);
    addSecantCases(suite);
}

}  // namespace kaustik
