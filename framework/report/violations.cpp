// SPDX-License-Identifier: MIT
#include "framework/report/violations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace kaustik::report {
namespace {

// "driver=dense emit=grid …": the nodes that light passes through, for whoever looks for the one.
std::string nodesOfLight(const params::ParamSet& settings) {
    std::vector<std::string> nodes;
    for (const char* stage :
         {DriverStage::name, EmitStage::name, SpecularStage::name, TraceStage::name,
          ReconstructStage::name, FilterStage::name, GatherStage::name}) {
        nodes.push_back(fmt::format("{}={}", stage, settings.choice(stage)));
    }
    return fmt::format("{}", fmt::join(nodes, " "));
}

}  // namespace

std::vector<std::string> violations(const EnergyLedger& ledger, const Renderer& renderer) {
    const params::ParamSet& settings = renderer.settings().params;
    const FrameFacts facts{renderer.registry(), settings, &renderer.needs()};
    std::vector<std::string> found;
    const double balance = ledger.balance();
    const bool hasBalance =
        !facts.traits<TraceStage>().multipliesLight && renderer.settings().disabledPasses.empty();
    if (hasBalance && !(std::abs(balance) <= kLargestBalance)) {
        found.push_back(fmt::format(
            "Energy is not conserved: of {:.4g} W emitted, {:.3g}% {} (balance {:.1e}); one of the "
            "nodes {} is at fault, and nothing that this run shows can be relied on.",
            ledger.watts[transport::kAccountEmitted], 100.0 * std::abs(balance),
            balance > 0.0 ? "are in no account" : "more are in the accounts", balance,
            nodesOfLight(settings)));
    }
    const std::uint64_t strange = ledger.events[transport::kAccountNotANumber];
    if (strange > 0) {
        found.push_back(fmt::format("{} photon{} became no number on the way through the nodes {}.",
                                    strange, strange == 1 ? "" : "s", nodesOfLight(settings)));
    }
    return found;
}

}  // namespace kaustik::report
