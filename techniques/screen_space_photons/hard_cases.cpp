// SPDX-License-Identifier: MIT
// Hard cases of these nodes alone; those that all tracers share are in framework/numerics/cases.
#include "framework/numerics/lab.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {

void addScreenSpacePhotonCases(numerics::Suite& suite) {
    // What the reduce leaves right of the longest line is memory that nothing reads.
    suite.allowUnwritten("trace.rows_");
}

}  // namespace kaustik
