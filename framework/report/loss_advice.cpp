// SPDX-License-Identifier: MIT
#include "framework/report/loss_advice.h"

#include <fmt/format.h>

namespace kaustik::report {
namespace {

using namespace transport;

// What does not see all that light reaches: the lights' maps, or a tracer that looks for receivers
// in what a light sees first.
std::string otherView(const params::ParamSet& settings) {
    std::string instead;
    if (settings.choice(TraceStage::name) == "background") instead = "trace=hierarchical";
    if (settings.find("reconstruct.space").text() != "screen") {
        instead += fmt::format("{}reconstruct.space=screen and gather=screen",
                               instead.empty() ? "" : " with ");
    }
    return instead;
}

}  // namespace

std::vector<std::string> lossAdvice(const EnergyLedger& ledger, const Renderer& renderer) {
    std::vector<std::string> advice;
    const double emitted = ledger.watts[kAccountEmitted];
    const double hidden =
        (ledger.watts[kAccountHiddenInMap] + ledger.watts[kAccountOutsideMap]) / emitted;
    const std::string instead = otherView(renderer.settings().params);
    if (emitted > 0.0 && hidden > kLossWithoutAWord && !instead.empty()) {
        advice.push_back(fmt::format(
            "{:.3g}% of the light comes to receivers that are not in the view in which it is "
            "looked for or stored (hidden_in_map, outside_map); {} loses none of it to that.",
            100.0 * hidden, instead));
    }
    const double discarded = ledger.watts[kAccountDiscardedTriangle] / emitted;
    if (emitted > 0.0 && discarded > kLossWithoutAWord) {
        advice.push_back(fmt::format(
            "{:.3g}% of the light lies between photons that are not joined (discarded_triangle); "
            "reconstruct.triangles.unjoined=beams covers it.",
            100.0 * discarded));
    }
    return advice;
}

}  // namespace kaustik::report
