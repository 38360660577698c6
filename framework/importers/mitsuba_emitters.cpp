// SPDX-License-Identifier: MIT
// Emitters of a Mitsuba scene that stand in no shape.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/importers/mitsuba_parts.h"

namespace kaustik::scene {
namespace {

glm::dvec3 unitAlong(const glm::dvec3& direction, const MitsubaElement& element) {
    if (!(glm::length(direction) > 1e-12)) failAt(element.place, "this light has no direction.");
    return glm::normalize(direction);
}

glm::dvec3 intensityOf(MitsubaImport& importer, const MitsubaElement& element) {
    if (element.child("power") == nullptr)
        return evenColor(importer, element, "intensity", glm::dvec3(1.0));
    return evenColor(importer, element, "power", glm::dvec3(1.0)) / (4.0 * std::acos(-1.0));
}

Light pointLight(MitsubaImport& importer, const MitsubaElement& element) {
    Light light;
    light.kind = LightKind::point;
    const glm::dvec3 origin(element.transform("to_world")[3]);
    light.position = element.point("position", origin);
    light.power = glm::vec3(glm::max(intensityOf(importer, element), 0.0));
    return light;
}

Light spotLight(MitsubaImport& importer, const MitsubaElement& element) {
    Light light;
    light.kind = LightKind::spot;
    const glm::dmat4 toWorld = element.transform("to_world");
    light.position = glm::dvec3(toWorld[3]);
    light.direction = unitAlong(glm::dvec3(toWorld[2]), element);
    light.power =
        glm::vec3(glm::max(evenColor(importer, element, "intensity", glm::dvec3(1.0)), 0.0));
    const double outer = std::clamp(element.number("cutoff_angle", 20.0), 0.1, 89.9);
    const double inner = std::clamp(element.number("beam_width", 0.75 * outer), 0.0, outer);
    light.outerConeRadians = static_cast<float>(glm::radians(outer));
    light.innerConeRadians = static_cast<float>(glm::radians(inner));
    return light;
}

Light directionalLight(MitsubaImport& importer, const MitsubaElement& element) {
    Light light;
    light.kind = LightKind::directional;
    const glm::dvec3 z(element.transform("to_world")[2]);
    light.direction = unitAlong(element.point("direction", z), element);
    light.power =
        glm::vec3(glm::max(evenColor(importer, element, "irradiance", glm::dvec3(1.0)), 0.0));
    return light;
}

void readEnvironmentMap(MitsubaImport& importer, const MitsubaElement& element) {
    const MitsubaElement* const name = element.child("filename");
    if (name == nullptr) failAt(element.place, "an envmap needs a 'filename'.");
    ForeignScene& scene = importer.scene;
    scene.environment = ForeignImage{importer.document.file(name->required("value")), name->place};
    scene.backgroundRadiance = glm::dvec3(std::max(element.number("scale", 1.0), 0.0));
    const glm::dmat4 toWorld = element.transform("to_world");
    scene.environmentTurnDegrees = environmentTurn(glm::dvec3(toWorld[2]));
    if (std::abs(toWorld[1].x) + std::abs(toWorld[1].z) > 1e-6 || toWorld[1].y <= 0.0)
        importer.change(element, "it is turned about the vertical alone");
}

}  // namespace

void readMitsubaEmitter(MitsubaImport& importer, const MitsubaElement& element) {
    const std::string& type = element.type();
    ForeignScene& scene = importer.scene;
    if (type == "constant") {
        scene.backgroundRadiance =
            glm::max(evenColor(importer, element, "radiance", glm::dvec3(1.0)), 0.0);
        return;
    }
    if (type == "envmap") return readEnvironmentMap(importer, element);
    if (type == "area") failAt(element.place, "an area light shines from a shape, and is in none.");
    if (type != "point" && type != "spot" && type != "directional")
        return importer.leaveOut(element, "there is no such light");
    Light light = type == "point"  ? pointLight(importer, element)
                  : type == "spot" ? spotLight(importer, element)
                                   : directionalLight(importer, element);
    light.name = importer.nameOf(element);
    scene.lights.push_back(std::move(light));
}

}  // namespace kaustik::scene
