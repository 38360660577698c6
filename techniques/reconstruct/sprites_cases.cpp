// SPDX-License-Identifier: MIT
// Hard cases of these nodes alone; those that all tracers share are in framework/numerics/cases.
#include "techniques/register_hard_cases.h"

#include <fmt/format.h>

#include "framework/numerics/kernel_weights.h"

namespace kaustik {
namespace {

using namespace numerics;

// Every shape with every kernel; the default pair is a case of all reconstructions.
void everyKernel(Lab& lab) {
    const Lab::Choice sprites = lab.choose(ReconstructStage::name, "sprites");
    for (const char* shape : {"beam", "disc"}) {
        for (const char* kernel : {"gaussian", "linear", "epanechnikov"}) {
            expectKernelWeights(
                lab, sprites,
                {{"reconstruct.sprites.shape", shape}, {"reconstruct.sprites.kernel", kernel}},
                fmt::format(" by {} and {}", shape, kernel));
        }
    }
}

}  // namespace

void addSpritesCases(Suite& suite) {
    // What the reduce leaves right of the longest line is memory that nothing reads.
    suite.allowUnwritten("trace.rows_");
    suite.add("D31", "", everyKernel);
}

}  // namespace kaustik
