// SPDX-License-Identifier: MIT
#include "framework/report/limits.h"

#include <fmt/format.h>

#include "framework/pipeline/stage_params.h"
#include "framework/scene/dielectrics.h"

namespace kaustik::report {
namespace {

using namespace transport;

double shareOfEmitted(const EnergyLedger& ledger, double watts) {
    const double emitted = ledger.watts[kAccountEmitted];
    return emitted > 0.0 ? 100.0 * watts / emitted : 0.0;
}

}  // namespace

std::vector<ReachedLimit> reachedLimits(const RunRecord& record, const Renderer& renderer) {
    std::vector<ReachedLimit> limits;
    const LayerStatistics& layers = record.layers;
    const EnergyLedger& ledger = record.ledger;
    if (layers.skipped > 0) {
        const double lost = ledger.watts[kAccountBeyondLastLayer];
        limits.push_back({"layers.count", "layers", static_cast<double>(record.layersAllowed),
                          static_cast<double>(layers.complexity),
                          fmt::format("{} of {} fragments, in {} pixels, lie beyond the last layer",
                                      layers.skipped, layers.fragments, layers.pixelsSkipped),
                          lost});
    }
    const int bounces = renderer.settings().params.get<SpecularParams>("specular").bounces;
    const double atLimit =
        ledger.watts[kAccountBounceLimit] + ledger.watts[kAccountInternalReflectionLimit];
    const std::uint64_t photons =
        ledger.events[kAccountBounceLimit] + ledger.events[kAccountInternalReflectionLimit];
    // Nodes that cannot go on, whatever the limit, have said so in the ledger alone.
    if (photons > 0 && !record.photonsEnd) {
        limits.push_back({"specular.bounces", "bounces", static_cast<double>(bounces), 0.0,
                          fmt::format("{} photons were still on their way, {:.3g}% of the flux",
                                      photons, shareOfEmitted(ledger, atLimit)),
                          atLimit});
    }
    const std::uint64_t nested = ledger.events[kAccountNestingLimit];
    if (nested > 0) {
        const double lost = ledger.watts[kAccountNestingLimit];
        limits.push_back({"specular.nesting", "dielectrics",
                          static_cast<double>(numberDielectrics(renderer.scene()).depth), 0.0,
                          fmt::format("{} photons entered a dielectric inside of more others, "
                                      "{:.3g}% of the flux; a scene of fewer materials has room "
                                      "for more",
                                      nested, shareOfEmitted(ledger, lost)),
                          lost});
    }
    limits.insert(limits.end(), record.nodeLimits.begin(), record.nodeLimits.end());
    return limits;
}

}  // namespace kaustik::report
