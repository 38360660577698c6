// SPDX-License-Identifier: MIT
// Hard cases of the shared nodes alone.
#include "techniques/register_hard_cases.h"

#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"

namespace kaustik {
namespace {

using namespace numerics;

// D34a: a lamp 2 m above water that fills 30 degrees to each side of its axis. A texel of the grid
// sees the solid angle A cos³ of its middle, for a rectangle A on the plane at 1 m.
void solidAngleOfATexel(Lab& lab) {
    const double height = 2.0;
    const double tangent = 0.57735026918962576;
    const double intensity = 100.0;
    constexpr int kTexels = 32;
    const scene::Scene scene = makeScene(
        {{0.0, 6.0, 0.01}, {0.0, 0.0, 0.0}},
        fmt::format("[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, {}, 0]\n"
                    "intensity = {}\n",
                    number(height), number(intensity)) +
            floorPlane("water", "water", 2.0 * height * tangent, {0, 0, 0}) +
            floorPlane("floor", "grey", 12.0, {0, -1, 0}));
    const Lab::Choice grid = lab.choose(EmitStage::name, "grid");
    const Emitted emitted =
        emitPhotons(lab, grid, scene, {{"emit.photons", fmt::format("{0}x{0}", kTexels)}});
    double worst = 0.0;
    std::size_t photons = 0;
    for (const StageHit& hit : emitted.hits) {
        if (hit.fate != transport::kFateSpecular) continue;
        ++photons;
        const double side = 2.0 * tangent / kTexels;
        const double x = hit.position.x / height;
        const double z = hit.position.z / height;
        const double flux = intensity * side * side * std::pow(1.0 + x * x + z * z, -1.5);
        worst = std::max(worst, std::abs(hit.fluxWatts.g / flux - 1.0));
    }
    lab.expect(grid.subject, "photons of a grid of 32 x 32", kTexels * kTexels,
               static_cast<double>(photons), kExactly);
    lab.expectDeviation(grid.subject, "worst relative error of a texel's flux, by cos³", worst,
                        {1e-5, "positions of 1e-7 m in a cosine, cubed, and 32-bit products"});
}

}  // namespace

void addGridCases(Suite& suite) {
    suite.add("D34a", "", solidAngleOfATexel);
}

}  // namespace kaustik
