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

std::string whyNoEffect(const FrameFacts& facts, const std::string& name) {
    const params::Field field = facts.settings.find(name);
    const auto dot = name.find('.');
    const auto nodeEnd = dot == std::string::npos ? dot : name.find('.', dot + 1);
    const std::string stage = name.substr(0, dot);
    if (!facts.isRead(name)) {
        const std::string reason = whyStageIsIdle(facts, stage);
        if (!reason.empty()) return reason;
        if (nodeEnd != std::string::npos) {
            const std::string chosen = facts.settings.choice(stage);
            if (chosen != name.substr(dot + 1, nodeEnd - dot - 1))
                return fmt::format("with {}={}", stage, chosen);
        }
    }
    for (const params::Condition& condition : field.conditions) {
        const std::string reason = condition(facts);
        if (!reason.empty()) return reason;
    }
    return field.obstacle;
}

std::string sayNoEffect(const std::string& name, const std::string& reason) {
    return fmt::format("{} has no effect{} {}.", name, reason.starts_with("with ") ? "" : ":",
                       reason);
}

}  // namespace kaustik
