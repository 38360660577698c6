// SPDX-License-Identifier: MIT
// What someone changes about a scene without touching its file: camera, lights, waves, medium,
// time. As a value, so that it can be kept, undone, sent to another thread, and written as a scene
// file of its own that `extends` the other (experiments/scenes/README.md). Units as in scene.h.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

struct LightEdit {
    // The direction of a directional or spot light as it is written, of any length above 0.
    std::optional<glm::dvec3> direction;
    std::optional<glm::dvec3> position;  // m; point and spot
    std::optional<float> powerFactor;    // on Light::power, >= 0
    // Of a directional light's disc; 0: parallel rays.
    std::optional<double> angularDiameterDegrees = {};
    friend bool operator==(const LightEdit&, const LightEdit&) = default;
};

struct SceneEdits {
    std::optional<Camera> camera;
    std::map<std::string, LightEdit> lights;         // by name
    std::map<std::string, std::vector<Wave>> waves;  // by the name of a water's object
    std::optional<Medium> medium;                    // instead of the scene's own
    std::optional<double> timeSeconds;
    friend bool operator==(const SceneEdits&, const SceneEdits&) = default;
};

// Takes the edits over. Throws ConfigError, and changes nothing, for a light or a water that the
// scene does not have (with the nearest that it has) and for what the kind of light does not take.
void applyEdits(Scene& scene, const SceneEdits& edits);
// A light of the scene with what the edits say of it.
[[nodiscard]] Light withEdits(Light light, const SceneEdits& edits);

// A scene file that extends `base` (a name, or a path as seen from the file's folder) by the edits.
// Loading it gives the same bits as applyEdits on the scene of `base`.
[[nodiscard]] std::string writeSceneFile(const std::string& name, const std::string& base,
                                         const SceneEdits& edits);

}  // namespace kaustik::scene
