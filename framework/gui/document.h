// SPDX-License-Identifier: MIT
// What is worked on in the workbench, as a value: scene, changes to it, size, and one or two ways
// to render it. Everything that decides a picture is here, so that it can be sent to another
// thread, compared, kept over a restart and written as an experiment.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/params/field.h"
#include "framework/pipeline/default_technique.h"
#include "framework/pipeline/renderer.h"
#include "framework/scene/scene_edits.h"

namespace kaustik::gui {

// One way to render: what `kaustik run` takes as --technique,
// --as-published, --set and --disable.
struct Variant {
    std::string technique = kDefaultTechnique;
    std::map<std::string, std::string> assignments;  // by full name
    std::set<std::string> disabled;                  // passes, by full name
    bool isAsPublished = false;                      // of the technique its paper's row
    friend bool operator==(const Variant&, const Variant&) = default;
};

struct Document {
    std::string scene = "pool";  // a name or a file's path, as `kaustik run` takes it
    scene::SceneEdits edits;
    params::Extent size{800, 600};
    Variant variant;               // A
    std::optional<Variant> other;  // B, next to it
    friend bool operator==(const Document&, const Document&) = default;
};

// Whether they differ in this alone: each one's A is the other's B.
[[nodiscard]] bool areSwapped(const Document& a, const Document& b);

// Throws ConfigError for what the registry does not have or a parameter does not take.
[[nodiscard]] RenderSettings settingsOf(const Variant& variant, const params::Extent& size,
                                        const Registry& registry);

// The scene with its changes. Throws what loading it throws.
[[nodiscard]] scene::Scene sceneOf(const Document& document);

[[nodiscard]] nlohmann::json toJson(const Document& document);
// What makes no sense gives a new document, and a sentence that says so: a restart must never fail
// for it.
[[nodiscard]] Document documentFromJson(const nlohmann::json& json,
                                        std::vector<std::string>& problems);

}  // namespace kaustik::gui
