// SPDX-License-Identifier: MIT
#include "framework/scene/needs.h"

#include <algorithm>

#include "framework/scene/height_field.h"

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

bool isSheet(const Mesh& mesh) {
    if (mesh.closed) return false;
    if (mesh.heightField) return true;
    glm::vec3 mean(0.0f);
    for (const glm::vec3& normal : mesh.normals)
        mean += normal;
    return std::all_of(mesh.normals.begin(), mesh.normals.end(),
                       [&](const glm::vec3& normal) { return glm::dot(normal, mean) > 0.0f; });
}

SceneNeeds sceneNeeds(const Scene& scene) {
    SceneNeeds needs;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        if (mesh.triangles.empty()) continue;
        needs.animated = needs.animated || moves(mesh);
        switch (scene.materials[object.material].kind) {
            case MaterialKind::glossy:
                needs.glossyReceivers = true;
                [[fallthrough]];
            case MaterialKind::lambertian:
                needs.receivers = true;
                break;
            case MaterialKind::dielectric:
                ++needs.refractors;
                needs.specularInterfaces += mesh.closed ? 2 : 1;
                needs.closedDielectrics = needs.closedDielectrics || mesh.closed;
                break;
            case MaterialKind::mirror:
                if (needs.reflectors++ == 0) ++needs.specularInterfaces;
                break;
        }
    }
    needs.lights = static_cast<int>(scene.lights.size());
    const glm::vec3 none(0.0f);
    needs.medium = scene.medium && (scene.medium->scatteringPerMeter != none ||
                                    scene.medium->absorptionPerMeter != none);
    needs.scatteringMedium = scene.medium && scene.medium->scatteringPerMeter != none;
    return needs;
}

}  // namespace kaustik::scene
