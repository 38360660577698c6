// SPDX-License-Identifier: MIT
#include "framework/gui/document.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "framework/core/json_number.h"
#include "framework/run/settings.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {
namespace {

using nlohmann::json;
using scene::SceneEdits;

json vectorJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
json vectorJson(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}
template <class V>
V vectorFrom(const json& j) {
    using Number = typename V::value_type;
    return {j.at(0).get<Number>(), j.at(1).get<Number>(), j.at(2).get<Number>()};
}

json variantJson(const Variant& variant) {
    return {{"technique", variant.technique},
            {"as_published", variant.isAsPublished},
            {"set", variant.assignments},
            {"disable", variant.disabled}};
}

Variant variantFrom(const json& j) {
    Variant variant;
    variant.technique = j.at("technique").get<std::string>();
    variant.isAsPublished = j.value("as_published", false);  // versions before had no such row
    variant.assignments = j.at("set").get<std::map<std::string, std::string>>();
    variant.disabled = j.at("disable").get<std::set<std::string>>();
    return variant;
}

json cameraJson(const scene::Camera& camera) {
    return {{"position", vectorJson(camera.position)},
            {"target", vectorJson(camera.target)},
            {"up", vectorJson(camera.up)},
            {"vertical_fov_degrees", camera.verticalFovDegrees},
            {"near", camera.nearMeters}};
}

scene::Camera cameraFrom(const json& j) {
    scene::Camera camera;
    camera.position = vectorFrom<glm::dvec3>(j.at("position"));
    camera.target = vectorFrom<glm::dvec3>(j.at("target"));
    camera.up = vectorFrom<glm::dvec3>(j.at("up"));
    camera.verticalFovDegrees = j.at("vertical_fov_degrees");
    camera.nearMeters = j.at("near");
    return camera;
}

json editsJson(const SceneEdits& edits) {
    json result = json::object();
    if (edits.camera) result["camera"] = cameraJson(*edits.camera);
    if (edits.timeSeconds) result["time"] = *edits.timeSeconds;
    if (edits.medium) {
        result["medium"] = {{"scattering", vectorJson(edits.medium->scatteringPerMeter)},
                            {"absorption", vectorJson(edits.medium->absorptionPerMeter)},
                            {"anisotropy", edits.medium->anisotropy}};
    }
    for (const auto& [name, edit] : edits.lights) {
        json& light = result["lights"][name] = json::object();
        if (edit.direction) light["direction"] = vectorJson(*edit.direction);
        if (edit.position) light["position"] = vectorJson(*edit.position);
        if (edit.powerFactor) light["power_factor"] = *edit.powerFactor;
        if (edit.angularDiameterDegrees)
            light["angular_diameter_degrees"] = *edit.angularDiameterDegrees;
    }
    for (const auto& [name, waves] : edits.waves) {
        json& list = result["waves"][name] = json::array();
        for (const scene::Wave& wave : waves) {
            list.push_back({wave.amplitudeMeters, wave.wavelengthMeters, wave.directionDegrees,
                            wave.phaseRadians, wave.omegaRadiansPerSecond});
        }
    }
    return result;
}

SceneEdits editsFrom(const json& j) {
    SceneEdits edits;
    if (j.contains("camera")) edits.camera = cameraFrom(j.at("camera"));
    if (j.contains("time")) edits.timeSeconds = j.at("time").get<double>();
    if (j.contains("medium")) {
        const json& medium = j.at("medium");
        edits.medium =
            scene::Medium{vectorFrom<glm::vec3>(medium.at("scattering")),
                          vectorFrom<glm::vec3>(medium.at("absorption")), medium.at("anisotropy")};
    }
    const json lights = j.value("lights", json::object());
    for (const auto& [name, light] : lights.items()) {
        scene::LightEdit& edit = edits.lights[name];
        if (light.contains("direction"))
            edit.direction = vectorFrom<glm::dvec3>(light.at("direction"));
        if (light.contains("position"))
            edit.position = vectorFrom<glm::dvec3>(light.at("position"));
        if (light.contains("power_factor")) edit.powerFactor = light.at("power_factor");
        if (light.contains("angular_diameter_degrees"))
            edit.angularDiameterDegrees = light.at("angular_diameter_degrees");
    }
    const json waters = j.value("waves", json::object());
    for (const auto& [name, list] : waters.items()) {
        std::vector<scene::Wave>& waves = edits.waves[name];
        for (const json& wave : list)
            waves.push_back({wave.at(0).get<float>(), wave.at(1).get<float>(),
                             wave.at(2).get<float>(), wave.at(3).get<float>(),
                             wave.at(4).get<float>()});
    }
    return edits;
}

}  // namespace

bool areSwapped(const Document& a, const Document& b) {
    if (!b.other || b.variant == *b.other) return false;
    Document exchanged = b;
    std::swap(exchanged.variant, *exchanged.other);
    return a == exchanged;
}

RenderSettings settingsOf(const Variant& variant, const params::Extent& size,
                          const Registry& registry) {
    run::SettingsRequest request{.technique = variant.technique,
                                 .assignments = {},
                                 .disabledPasses = variant.disabled,
                                 .isAsPublished = variant.isAsPublished};
    for (const auto& [name, value] : variant.assignments)
        request.assignments.push_back({name, value, "workbench"});
    RenderSettings settings = run::makeSettings(request, registry);
    run::setSize(settings, size);
    return settings;
}

scene::Scene sceneOf(const Document& document) {
    scene::Scene scene = scene::loadScene(document.scene);
    scene::applyEdits(scene, document.edits);
    return scene;
}

json toJson(const Document& document) {
    json result = {{"scene", document.scene},
                   {"edits", editsJson(document.edits)},
                   {"size", {document.size.width, document.size.height}},
                   {"variant", variantJson(document.variant)}};
    if (document.other) result["other"] = variantJson(*document.other);
    return result;
}

Document documentFromJson(const json& j, std::vector<std::string>& problems) {
    try {
        Document document;
        document.scene = j.at("scene").get<std::string>();
        document.edits = editsFrom(j.at("edits"));
        document.size = {wholeNumber<int>(j.at("size").at(0)),
                         wholeNumber<int>(j.at("size").at(1))};
        document.variant = variantFrom(j.at("variant"));
        if (j.contains("other")) document.other = variantFrom(j.at("other"));
        const auto isSide = [](int side) { return side >= 1 && side <= params::kMaxPictureSide; };
        const bool isSize = isSide(document.size.width) && isSide(document.size.height);
        if (isSize) return document;
        problems.push_back(
            fmt::format("a picture of {}x{} cannot be", document.size.width, document.size.height));
    } catch (const json::exception& error) {
        problems.push_back(fmt::format("the document makes no sense ({})", error.what()));
    }
    return {};
}

}  // namespace kaustik::gui
