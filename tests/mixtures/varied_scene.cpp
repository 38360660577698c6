// SPDX-License-Identifier: MIT
#include "tests/mixtures/varied_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace kaustik::mixtures {
namespace {

void scale(scene::Scene& scene, double factor) {
    const glm::dmat4 larger = glm::scale(glm::dmat4(1.0), glm::dvec3(factor));
    const auto lengths = static_cast<float>(factor);
    scene.camera.position *= factor;
    scene.camera.target *= factor;
    scene.camera.nearMeters *= factor;
    for (scene::Object& object : scene.objects)
        object.toWorld = larger * object.toWorld;
    for (scene::Light& light : scene.lights) {
        light.position *= factor;
        light.rangeMeters *= lengths;
        if (light.kind != scene::LightKind::directional) light.power *= lengths * lengths;
    }
    for (scene::Material& material : scene.materials)
        material.absorptionPerMeter /= lengths;
    if (scene.medium) {
        scene.medium->scatteringPerMeter /= lengths;
        scene.medium->absorptionPerMeter /= lengths;
    }
}

void turn(scene::Scene& scene, double degrees) {
    const glm::dmat4 turned =
        glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0));
    const glm::dmat3 axes(turned);
    scene.camera.position = axes * scene.camera.position;
    scene.camera.target = axes * scene.camera.target;
    scene.camera.up = axes * scene.camera.up;
    scene.environmentTurnDegrees += degrees;
    for (scene::Object& object : scene.objects)
        object.toWorld = turned * object.toWorld;
    for (scene::Light& light : scene.lights) {
        light.position = axes * light.position;
        light.direction = axes * light.direction;
        light.up = axes * light.up;
    }
}

}  // namespace

scene::Scene varied(scene::Scene scene, const Variation& variation) {
    std::vector<std::string> before;
    for (const scene::Object& object : scene.objects)
        before.push_back(object.name);
    if (variation.scale != 1.0) scale(scene, variation.scale);
    if (variation.turnDegrees != 0.0) turn(scene, variation.turnDegrees);
    const auto light = static_cast<float>(variation.light);
    for (scene::Light& lamp : scene.lights)
        lamp.power *= light;
    scene.backgroundRadiance *= light;
    scene.ambientIrradiance *= light;
    if (variation.order != 0) {
        Random random(variation.order, 0);
        for (std::size_t i = scene.objects.size(); i > 1; --i)
            std::swap(scene.objects[i - 1], scene.objects[random.below(i)]);
        // The same order would say nothing.
        const bool isSame = std::equal(
            scene.objects.begin(), scene.objects.end(), before.begin(),
            [](const scene::Object& one, const std::string& other) { return one.name == other; });
        if (isSame)
            std::rotate(scene.objects.begin(), scene.objects.begin() + 1, scene.objects.end());
    }
    return scene;
}

}  // namespace kaustik::mixtures
