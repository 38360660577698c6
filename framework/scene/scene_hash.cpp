// SPDX-License-Identifier: MIT
#include "framework/scene/scene_hash.h"

#include <algorithm>

#include "framework/core/files.h"

namespace kaustik::scene {

// Field by field: structs may have padding.
void addTo(ContentHash& hash, const Scene& scene) {
    const Camera& camera = scene.camera;
    hash.add(camera.position).add(camera.target).add(camera.up);
    hash.add(camera.verticalFovDegrees).add(camera.nearMeters);
    // Points that stand for emitters are no part of the scene.
    const auto isOwn = [](const Light& light) { return light.emitter < 0 && light.band == 0; };
    hash.add(
        static_cast<std::size_t>(std::count_if(scene.lights.begin(), scene.lights.end(), isOwn)));
    for (const Light& light : scene.lights) {
        if (!isOwn(light)) continue;
        hash.add(light.kind).add(light.position).add(light.direction).add(light.power);
        hash.add(light.innerConeRadians).add(light.outerConeRadians).add(light.rangeMeters);
        hash.add(light.image).add(light.up);
    }
    for (const Emitter& emitter : scene.emitters) {
        const Light& sun = emitter.light;
        hash.add(sun.direction).add(sun.power).add(sun.angularDiameterRadians);
        hash.add(emitter.object.value_or(0));
    }
    if (scene.environmentLights) {
        hash.add(scene.backgroundRadiance).add(scene.environmentImage);
        hash.add(scene.environmentTurnDegrees);
    }
    hash.add(scene.materials.size());
    for (const Material& material : scene.materials) {
        hash.add(material.kind).add(material.albedo).add(material.pattern);
        hash.add(material.patternAlbedo).add(material.uvScale).add(material.image);
        hash.add(material.ior).add(material.absorptionPerMeter);
        if (material.dispersion != glm::vec4(0.0f)) hash.add(material.dispersion);
        hash.add(material.specular).add(material.exponent);
        if (material.emission != glm::vec3(0.0f)) hash.add(material.emission);
        if (material.normalMap >= 0) hash.add(material.normalMap).add(material.normalScale);
    }
    hash.add(scene.images.size());
    for (const TextureImage& image : scene.images) {
        hash.addBytes(image.file.empty() ? image.bytes : readFile(image.file));
        hash.add(static_cast<std::uint8_t>(image.srgb));
        if (image.isNormalMap) hash.add(image.isNormalMap);
    }
    hash.add(scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) {
        hash.add(mesh.origin).add(static_cast<std::uint8_t>(mesh.closed));
        hash.addAll(mesh.positions).addAll(mesh.normals).addAll(mesh.uvs).addAll(mesh.triangles);
    }
    hash.add(scene.objects.size());
    for (const Object& object : scene.objects)
        hash.add(object.mesh).add(object.material).add(object.toWorld);
    hash.add(static_cast<std::uint8_t>(scene.medium.has_value()));
    if (scene.medium) {
        hash.add(scene.medium->scatteringPerMeter).add(scene.medium->absorptionPerMeter);
        hash.add(scene.medium->anisotropy);
    }
}

}  // namespace kaustik::scene
