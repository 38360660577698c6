// SPDX-License-Identifier: MIT
// Why a parameter has no effect: one answer for warnings, `explain` and the workbench. It is put
// together from what is declared: by the parameter (params::Field::when), by its stage (whyIdle of
// a stage in stages.h), and by nodes that read parameters of others (NodeDescription::reads). What
// only a built graph knows Renderer::whyNoEffect adds.
#pragma once

#include <string>

#include "framework/pipeline/registry.h"
#include "framework/scene/needs.h"

namespace kaustik {

// What is known of a frame before it is built.
struct FrameFacts {
    const Registry& registry;
    const params::ParamSet& settings;
    const scene::SceneNeeds* needs = nullptr;  // where the scene is known

    // Of the node that the settings choose for a stage.
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
    // Whether photons have beams: the emitter makes them, and somebody uses them, or may.
    [[nodiscard]] bool usesBeams() const;
};

// Why the parameter, by its full name, has no effect, as params::Condition says it; "" where it has
// one, or may have. Throws ConfigError for a name that does not exist.
[[nodiscard]] std::string whyNoEffect(const FrameFacts& facts, const std::string& name);

// "trace.epsilon has no effect with trace.test=crossing."
[[nodiscard]] std::string sayNoEffect(const std::string& name, const std::string& reason);

}  // namespace kaustik
