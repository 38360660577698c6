// SPDX-License-Identifier: MIT
#include "framework/pipeline/effect.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik {
namespace {

std::string whyStageIsIdle(const FrameFacts& facts, const std::string& stage) {
    if (facts.isRead(stage)) return "";
    for (const Registry::StageEntry& entry : facts.registry.stages()) {
        if (entry.name == stage) return entry.whyIdle ? entry.whyIdle(facts) : "";
    }
    return "";
}

}  // namespace

bool FrameFacts::isRead(const std::string& name) const {
    const auto holds = [&](const std::string& read) {
        return name == read || name.starts_with(read + ".");
    };
    const auto& nodes = registry.nodes();
    return std::any_of(nodes.begin(), nodes.end(), [&](const Registry::Node& node) {
        const std::vector<std::string>& reads = node.description.reads;
        return std::any_of(reads.begin(), reads.end(), holds) &&
               settings.choice(node.stage) == node.name &&
               whyStageIsIdle(*this, node.stage).empty();
    });
}

bool FrameFacts::usesBeams() const {
    const bool mayScatter = needs == nullptr || needs->scatteringMedium;
    const bool areUsed =
        traits<ReconstructStage>().beams || (mayScatter && traits<MediaStage>().beams);
    return areUsed && traits<EmitStage>().beams;
}

bool FrameFacts::widensByLights() const {
    const auto widens = traits<ReconstructStage>().widensByLights;
    return usesBeams() && widens != nullptr && needs != nullptr && needs->emitters > 0 &&
           widens(*this);
}

std::string FrameFacts::whyNoNeighbours() const {
    const auto why = traits<DriverStage>().whyNoNeighbours;
    return why == nullptr ? "" : why(*this);
}

std::string noCausticReason(const FrameFacts& facts) {
    if (facts.needs == nullptr) return "";
    if (facts.needs->lights == 0) return "the scene has no light";
    if (facts.needs->specularInterfaces == 0) return "the scene has no specular surface";
    if (!facts.needs->receivers) return "the scene has no receiver";
    return "";
}

std::string whyNoScattering(const FrameFacts& facts) {
    if (facts.needs != nullptr && !facts.needs->scatteringMedium)
        return "the scene has no medium that scatters";
    return noCausticReason(facts);
}

std::string whyNoShadow(const FrameFacts& facts) {
    return facts.needs != nullptr && facts.needs->lights == 0 ? "the scene has no light" : "";
}

std::string whyNothingSeenThrough(const FrameFacts& facts) {
    const bool isKnown = facts.needs != nullptr;
    return isKnown && facts.needs->specularInterfaces == 0 ? "the scene has no specular surface"
                                                           : "";
}

ParameterName splitParameterName(const std::string& fullName) {
    const std::size_t stageEnd = std::min(fullName.find('.'), fullName.size());
    if (stageEnd == fullName.size()) return {fullName, "", ""};
    const std::string rest = fullName.substr(stageEnd + 1);
    const std::size_t nodeEnd = rest.find('.');
    if (nodeEnd == std::string::npos) return {fullName.substr(0, stageEnd), "", rest};
    return {fullName.substr(0, stageEnd), rest.substr(0, nodeEnd), rest.substr(nodeEnd + 1)};
}

bool isOfOtherNode(const ParameterName& name, const params::ParamSet& settings) {
    return !name.node.empty() && settings.choice(name.stage) != name.node;
}

std::string whyNoEffect(const FrameFacts& facts, const std::string& name) {
    const params::Field field = facts.settings.find(name);
    if (!facts.isRead(name)) {
        const ParameterName parts = splitParameterName(name);
        const std::string reason = whyStageIsIdle(facts, parts.stage);
        if (!reason.empty()) return reason;
        if (isOfOtherNode(parts, facts.settings))
            return fmt::format("with {}={}", parts.stage, facts.settings.choice(parts.stage));
    }
    for (const params::Condition& condition : field.conditions) {
        const std::string reason = condition(facts);
        if (!reason.empty()) return reason;
    }
    return field.obstacle;
}

std::string whyNoEffect(const FrameFacts& facts, const std::vector<graph::PassRecord>& passes,
                        const std::string& name) {
    const std::string reason = whyNoEffect(facts, name);
    if (!reason.empty()) return reason;
    const ParameterName parts = splitParameterName(name);
    const auto hasRun = [&](const auto& isMeant) {
        return std::any_of(passes.begin(), passes.end(), [&](const graph::PassRecord& pass) {
            return pass.state == graph::PassState::ran && isMeant(pass.name);
        });
    };
    const bool isOfAllLayers = parts.stage == LayersStage::name && parts.node.empty();
    if (isOfAllLayers &&
        !hasRun([](const std::string& pass) { return pass.starts_with("layers."); }))
        return "nothing needs the layers of what the eye sees";
    if (!isOfOtherNode(parts, facts.settings)) return "";
    const std::string node = parts.stage + "." + parts.node;
    const bool runs =
        hasRun([&](const std::string& pass) { return pass == node || pass.ends_with("." + node); });
    return runs ? "" : fmt::format("no pass of this frame is {}'s", node);
}

std::string sayNoEffect(const std::string& name, const std::string& reason) {
    return fmt::format("{} has no effect{} {}.", name, reason.starts_with("with ") ? "" : ":",
                       reason);
}

}  // namespace kaustik
