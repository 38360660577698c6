// SPDX-License-Identifier: MIT
#include "framework/report/loss_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    if (tracer == "raytraced" || tracer == "bvh" || tracer == "auto") return "";
    if (tracer == "background" || tracer == "plane")
        return "trace=hierarchical looks among all that the eye sees";
    if (tracer != "secant" && settings.find("trace.test").text() != "crossing")
        return "trace.test=crossing finds more, trace=raytraced all";
    return "trace=raytraced finds all";
}

// Whether photons are those that a body's front reflects, and are looked for in what lights see.
bool followsReflectedAlone(const params::ParamSet& settings) {
    const std::string tracer = settings.choice(TraceStage::name);
    return (tracer == "background" || tracer == "plane") &&
           settings.choice(SpecularStage::name) == "two_interfaces" &&
           settings.find("specular.two_interfaces.branch").text() == "reflected";
}

// What follows more branches; "" where another node is needed, whose photons are others.
std::string moreBranches(const params::ParamSet& settings) {
    const std::string specular = settings.choice(SpecularStage::name);
    if (specular == "interface") return "specular=split follows both";
    if (specular != "split" && specular != "auto") return "";
    const params::Field field = settings.find("specular.split.levels");
    const auto most = static_cast<int>(field.maximum);
    const int levels = std::stoi(field.text());
    if (levels >= most) return "";
    return fmt::format("specular=split and specular.split.levels={} follow more",
                       std::clamp(levels + 2, 3, most));
}

// Of what lights send onto specular surfaces, what an emitter may miss without a word.
constexpr double kUnspokenShare = 0.01;

// What misses less of it; "" where no setting does.
std::string betterEmission(const params::ParamSet& settings) {
    if (settings.choice(EmitStage::name) != "deferred") return "";
    if (settings.choice(DriverStage::name) == "adaptive" &&
        settings.find("refine.mask").text() == "off")
        return "; refine.mask=on misses less";
    const params::Field field = settings.find("emit.deferred.size");
    const auto largest = static_cast<int>(field.maximum);
    const int size = std::stoi(field.text());
    if (size >= largest) return "";
    return fmt::format("; emit.deferred.size={} misses less", std::min(4 * size, largest));
}

// "" where the emitter has emitted what it should.
std::string emissionMessage(const EnergyLedger& ledger, const params::ParamSet& settings) {
    const double wanted = ledger.watts[kAccountEmitted];
    const double missed = ledger.watts[kAccountEmissionSampling];
    if (std::abs(missed) <= kUnspokenShare * wanted) return "";
    return fmt::format(
        "emit={} emits {:.4g} W of the {:.4g} W that the lights send onto the specular surfaces "
        "that they see: {:.3g}% {} (emission_sampling){}.",
        settings.choice(EmitStage::name), wanted - missed, wanted,
        100.0 * std::abs(missed) / wanted, missed > 0.0 ? "are missing" : "are too much",
        missed > 0.0 ? betterEmission(settings) : "");
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
    // What trace.test=crossing does not find has left the scene, as a rule.
    const double unresolved =
        settings.find("trace.test").text() == "crossing" ? 0.0 : watts[kAccountUnresolved];
    if (followsReflectedAlone(settings)) {
        const double followed = emitted - watts[kAccountUntracedBranch];
        if (watts[kAccountUnresolved] > kLossWithoutAWord * followed) {
            advice.push_back(fmt::format(
                "{:.3g}% of what is reflected comes to nothing that trace={} finds, which looks "
                "where the light sees receivers (unresolved): it leaves the scene, or "
                "trace=hierarchical with reconstruct.space=screen and gather=screen finds more.",
                100.0 * watts[kAccountUnresolved] / followed, settings.choice(TraceStage::name)));
        }
    }
    say(watts[kAccountMissedByTracer] + watts[kAccountEdgeOn] + unresolved, otherTracer(settings),
        fmt::format("comes to nothing that trace={} finds (tracer, edge_on, unresolved)",
                    settings.choice(TraceStage::name)));
    say(watts[kAccountUntracedBranch], moreBranches(settings),
        "is in branches that are not followed (untraced_branch)");
    const std::string emission = emissionMessage(ledger, settings);
    if (!emission.empty()) advice.push_back(emission);
    return advice;
}

}  // namespace kaustik::report
