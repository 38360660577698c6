// SPDX-License-Identifier: MIT
#include "framework/report/limits.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/pipeline/stage_params.h"

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
    if (layers.leftOut > 0) {
        const double lost = ledger.watts[kAccountBeyondLastLayer];
        limits.push_back({"layers.count", static_cast<double>(record.layersAllowed),
                          static_cast<double>(layers.complexity),
                          fmt::format("{} of {} fragments, in {} pixels, lie beyond the last layer",
                                      layers.leftOut, layers.fragments, layers.pixelsLeftOut),
                          lost});
    }
    const int bounces = renderer.settings().params.get<SpecularParams>("specular").bounces;
    const double atLimit =
        ledger.watts[kAccountBounceLimit] + ledger.watts[kAccountInternalReflectionLimit];
    const std::uint64_t photons =
        ledger.events[kAccountBounceLimit] + ledger.events[kAccountInternalReflectionLimit];
    if (photons > 0) {
        limits.push_back({"specular.bounces", static_cast<double>(bounces), 0.0,
                          fmt::format("{} photons were still on their way, {:.3g}% of the flux",
                                      photons, shareOfEmitted(ledger, atLimit)),
                          atLimit});
    }
    // Batches cost time and nothing else, unless the ledger says so.
    for (const graph::PassRecord& pass : record.passes) {
        if (pass.name != "trace.lines" || pass.state != graph::PassState::ran) continue;
        const double lost = ledger.watts[kAccountBatchLimit];
        if (pass.repeats > 1 || lost > 0.0) {
            limits.push_back({"trace.lines.memory", static_cast<double>(pass.repeats), 1.0,
                              fmt::format("{} passes over the photons instead of one a tracing; "
                                          "{:.3g}% of the flux was lost to it",
                                          pass.repeats, shareOfEmitted(ledger, lost)),
                              lost});
        }
    }
    return limits;
}

nlohmann::json toJson(const std::vector<ReachedLimit>& limits) {
    nlohmann::json list = nlohmann::json::array();
    for (const ReachedLimit& limit : limits) {
        nlohmann::json entry = {{"limit", limit.parameter},
                                {"value", limit.value},
                                {"lost", limit.sentence},
                                {"lost_w", limit.lostWatts}};
        entry["needed"] = limit.needed > 0.0 ? nlohmann::json(limit.needed) : nlohmann::json();
        list.push_back(std::move(entry));
    }
    return list;
}

}  // namespace kaustik::report
