// SPDX-License-Identifier: MIT
#include "framework/report/loss_advice.h"

#include <fmt/format.h>

#include <algorithm>

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
    return instead.empty() ? "" : instead + " loses none of it to that";
}

// What finds more than the tracer does; "" where it finds all.
std::string otherTracer(const params::ParamSet& settings) {
    const std::string tracer = settings.choice(TraceStage::name);
    if (tracer == "raytraced") return "";
    if (tracer == "background" || tracer == "plane")
        return "trace=hierarchical looks among all that the eye sees";
    if (tracer != "secant" && settings.find("trace.test").text() != "crossing")
        return "trace.test=crossing finds more, trace=raytraced all";
    return "trace=raytraced finds all";
}

// What follows more branches; "" where another node is needed, whose photons are others.
std::string moreBranches(const params::ParamSet& settings) {
    const std::string specular = settings.choice(SpecularStage::name);
    if (specular == "interface") return "specular=split follows both";
    if (specular != "split") return "";
    const int levels = std::stoi(settings.find("specular.split.levels").text());
    return fmt::format("specular.split.levels={} follows more", std::max(levels + 2, 3));
}

}  // namespace

std::vector<std::string> lossAdvice(const EnergyLedger& ledger, const Renderer& renderer) {
    const double emitted = ledger.watts[kAccountEmitted];
    if (!(emitted > 0.0)) return {};
    std::vector<std::string> advice;
    const params::ParamSet& settings = renderer.settings().params;
    const auto say = [&](double watts, const std::string& instead, const std::string& sentence) {
        const double share = watts / emitted;
        if (share <= kLossWithoutAWord || instead.empty()) return;
        advice.push_back(
            fmt::format("{:.3g}% of the light {}; {}.", 100.0 * share, sentence, instead));
    };
    const auto& watts = ledger.watts;
    say(watts[kAccountHiddenInMap] + watts[kAccountOutsideMap], otherView(settings),
        "comes to receivers that are not in the view in which it is looked for or stored "
        "(hidden_in_map, outside_map)");
    say(watts[kAccountDiscardedTriangle], "reconstruct.triangles.unjoined=beams covers it",
        "lies between photons that are not joined (discarded_triangle)");
    say(watts[kAccountMissedByTracer] + watts[kAccountEdgeOn], otherTracer(settings),
        fmt::format("comes to surfaces that trace={} does not find (tracer, edge_on)",
                    settings.choice(TraceStage::name)));
    say(watts[kAccountUntracedBranch], moreBranches(settings),
        "is in branches that are not followed (untraced_branch)");
    return advice;
}

}  // namespace kaustik::report
