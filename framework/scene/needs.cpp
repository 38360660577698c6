// SPDX-License-Identifier: MIT
#include "framework/scene/needs.h"

#include <algorithm>
#include <vector>

#include "framework/scene/shapes/height_field.h"
#include "framework/scene/spectrum.h"

namespace kaustik::scene {
namespace {

bool moves(const Mesh& mesh) {
    if (!mesh.heightField) return false;
    return std::any_of(mesh.heightField->waves.begin(), mesh.heightField->waves.end(),
                       [](const Wave& wave) {
                           return wave.amplitudeMeters != 0.0f && angularFrequency(wave) > 0.0;
                       });
}

}  // namespace

SceneNeeds sceneNeeds(const Scene& scene) {
    SceneShapes shapes(scene);
    return sceneNeeds(shapes);
}

SceneNeeds sceneNeeds(SceneShapes& shapes) {
    const Scene& scene = shapes.scene();
    SceneNeeds needs;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        if (mesh.triangles.empty()) continue;
        needs.animated = needs.animated || moves(mesh);
        needs.emission =
            needs.emission || scene.materials[object.material].emission != glm::vec3(0.0f);
        switch (scene.materials[object.material].kind) {
            case MaterialKind::glossy:
                needs.glossyReceivers = true;
                [[fallthrough]];
            case MaterialKind::lambertian:
                needs.receivers = true;
                break;
            case MaterialKind::dielectric:
                ++needs.refractors;
                needs.specularInterfaces += mesh.hasInside                  ? 2
                                            : shapes.turnsBack(object.mesh) ? 3
                                                                            : 1;
                needs.closedDielectrics = needs.closedDielectrics || mesh.hasInside;
                break;
            case MaterialKind::mirror:
                if (needs.reflectors++ == 0) ++needs.specularInterfaces;
                break;
        }
    }
    needs.repeatedHits = repeatedHits(shapes);
    needs.reflectedLight = reflectedLight(shapes);
    needs.concaveBody = concaveBody(shapes);
    needs.bodies = shapes.bodies();
    needs.nestedBodies = needs.closedDielectrics && shapes.hasNestedBodies();
    needs.photonLights = static_cast<int>(scene.lights.size());
    needs.disperses = disperses(scene);
    needs.bands = std::max(static_cast<int>(scene.bands.size()), 1);
    needs.lights = needs.photonLights / needs.bands;
    needs.emitters = static_cast<int>(scene.emitters.size());
    const glm::vec3 none(0.0f);
    needs.medium = scene.medium && (scene.medium->scatteringPerMeter != none ||
                                    scene.medium->absorptionPerMeter != none);
    needs.scatteringMedium = scene.medium && scene.medium->scatteringPerMeter != none;
    return needs;
}

}  // namespace kaustik::scene
