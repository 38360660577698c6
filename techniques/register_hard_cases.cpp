// SPDX-License-Identifier: MIT
#include "techniques/register_hard_cases.h"

#include "techniques/caustic_triangles/hard_cases.h"
#include "techniques/screen_space_photons/hard_cases.h"
#include "techniques/shared/hard_cases.h"

namespace kaustik {

void registerHardCases(numerics::Suite& suite) {
    addSharedCases(suite);
    addScreenSpacePhotonCases(suite);
    addViewCases(suite);
    addNestedCases(suite);
    addCausticTrianglesCases(suite);
}

}  // namespace kaustik
