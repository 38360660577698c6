// SPDX-License-Identifier: MIT
// Why a parameter has no effect: one answer for warnings, `explain` and the workbench. It is put
// together from what is declared: by the parameter (params::Field::when), by its stage (whyIdle of
// a stage in stages.h), and by nodes that read parameters of others (NodeDescription::reads); and,
// once a frame is built, from which passes it has.
#pragma once

#include <string>
#include <vector>

#include "framework/graph/graph.h"
#include "framework/pipeline/registry.h"
#include "framework/scene/needs.h"

namespace kaustik {

// What is known of a frame before it is built.
struct FrameFacts {
    const Registry& registry;
    const params::ParamSet& settings;
    const scene::SceneNeeds* needs = nullptr;  // where the scene is known

    // The traits of the node that the settings choose for a stage.
    template <class Stage>
    [[nodiscard]] const typename Stage::Traits& traits() const {
        return registry.traits<Stage>(settings.choice(Stage::name));
    }
    // "with STAGE=NODE", for a condition.
    template <class Stage>
    [[nodiscard]] std::string withChosen() const {
        return std::string("with ") + Stage::name + "=" + settings.choice(Stage::name);
    }
    // Whether a chosen node of a stage that runs reads the parameter, which is not its own.
    [[nodiscard]] bool isRead(const std::string& name) const;
    // Whether photons have beams: the emitter makes them, and a chosen node uses them, or may.
    [[nodiscard]] bool usesBeams() const;
    // Whether photons carry by how much their lights, which have a size, spread them.
    [[nodiscard]] bool widensByLights() const;
    // Why photons have no neighbours that they could be joined with; "" where they have, or may.
    [[nodiscard]] std::string whyNoNeighbours() const;
};

// The parts of a parameter's full name: "trace.lines.rows", "trace.epsilon" or "trace".
struct ParameterName {
    std::string stage;
    std::string node;       // "" for what all nodes of the stage share, and for the stage's choice
    std::string parameter;  // "" for the stage's choice of its node
};
[[nodiscard]] ParameterName splitParameterName(const std::string& fullName);

// Whether the parameter is one of a node that the settings do not choose for its stage.
[[nodiscard]] bool isOfOtherNode(const ParameterName& name, const params::ParamSet& settings);

// Why the parameter, by its full name, has no effect, as params::Condition says it; "" where it has
// one, or may have. Throws ConfigError for a name that does not exist.
[[nodiscard]] std::string whyNoEffect(const FrameFacts& facts, const std::string& name);

// Answers the same for a frame that is built, with these passes: a node that is not chosen may
// stand in for one that is (specular.split for specular.auto), and only the passes say whether it
// does.
[[nodiscard]] std::string whyNoEffect(const FrameFacts& facts,
                                      const std::vector<graph::PassRecord>& passes,
                                      const std::string& name);

// "trace.epsilon has no effect with trace.test=crossing."
[[nodiscard]] std::string sayNoEffect(const std::string& name, const std::string& reason);

}  // namespace kaustik
