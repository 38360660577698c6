// SPDX-License-Identifier: MIT
#include "framework/report/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

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
    const bool splits =
        std::any_of(renderer.compiled().records.begin(), renderer.compiled().records.end(),
                    [](const graph::PassRecord& pass) {
                        return pass.name == "specular.split" && pass.state == graph::PassState::ran;
                    });
    const std::uint64_t untraced = ledger.events[kAccountUntracedBranch];
    if (splits && untraced > 0) {
        const double lost = ledger.watts[kAccountUntracedBranch];
        const auto levels = renderer.settings().params.find("specular.split.levels").json();
        limits.push_back({"specular.split.levels", "levels", levels.get<double>(), 0.0,
                          fmt::format("{} branches were left out for want of room, {:.3g}% of the "
                                      "flux",
                                      untraced, shareOfEmitted(ledger, lost)),
                          lost});
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
    for (const ReachedLimit& limit : record.nodeLimits) {
        limits.push_back(limit);
        if (limit.counted.empty()) continue;
        const std::string share =
            limit.countedWatts > 0.0
                ? fmt::format(", {:.3g}% of the flux", shareOfEmitted(ledger, limit.countedWatts))
                : "";
        limits.back().sentence =
            fmt::format("{} {}{}; {}", limit.count, limit.counted, share, limit.sentence);
    }
    return limits;
}

}  // namespace kaustik::report
