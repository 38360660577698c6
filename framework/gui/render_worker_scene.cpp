// SPDX-License-Identifier: MIT
// The scene of the render worker: read when another one is asked for, and changed as the document
// says.
#include "framework/core/error.h"
#include "framework/gui/render_worker.h"
#include "framework/gui/render_worker_device.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::gui {
namespace {

// Makes what can be edited as it is in the file, then as the document says.
void updateScene(scene::Scene& scene, const scene::Scene& base, const scene::SceneEdits& edits) {
    scene.camera = base.camera;
    scene.lights = base.lights;
    scene.emitters = base.emitters;
    scene.medium = base.medium;
    bool moved = scene.timeSeconds != edits.timeSeconds.value_or(base.timeSeconds);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!scene.meshes[i].heightField) continue;
        moved = moved || scene.meshes[i].heightField->waves != base.meshes[i].heightField->waves;
        scene.meshes[i].heightField->waves = base.meshes[i].heightField->waves;
    }
    scene.timeSeconds = base.timeSeconds;
    applyEdits(scene, edits);
    if (moved && !edits.timeSeconds && edits.waves.empty()) setTime(scene, base.timeSeconds);
}

std::shared_ptr<const SceneFacts> factsOf(const scene::Scene& base, scene::SceneShapes& shapes) {
    const scene::Scene& scene = shapes.scene();
    auto facts = std::make_shared<SceneFacts>();
    facts->name = scene.name;
    facts->description = scene.description;
    facts->triangles = triangleCount(scene);
    facts->needs = sceneNeeds(shapes);
    facts->bounds = sceneBounds(scene);
    facts->camera = base.camera;
    for (const scene::Light& light : base.lights) {
        if (light.emitter < 0) facts->lights.push_back(light);
    }
    for (const scene::Emitter& emitter : base.emitters) {
        if (emitter.isDisc()) facts->lights.push_back(emitter.light);
    }
    facts->medium = base.medium;
    facts->timeSeconds = base.timeSeconds;
    for (const scene::Object& object : base.objects) {
        const scene::Mesh& mesh = base.meshes[object.mesh];
        if (mesh.heightField) facts->waters.push_back({object.name, mesh.heightField->waves});
    }
    return facts;
}

}  // namespace

bool RenderWorker::loadScene(Device& device) {
    const Document& document = device.order.document;
    try {
        if (!device.base || device.sceneName != document.scene ||
            device.sceneReloads != device.order.sceneReloads) {
            auto base = std::make_unique<scene::Scene>(scene::loadScene(document.scene));
            device.renderers = {};
            working_.variants = {};
            device.base = std::move(base);
            device.shapes.reset();  // of the scene that goes
            device.scene = std::make_unique<scene::Scene>(*device.base);
            device.shapes.emplace(*device.scene);
            device.sceneName = document.scene;
            device.sceneReloads = device.order.sceneReloads;
            device.edits = scene::SceneEdits();
            working_.scene = factsOf(*device.base, *device.shapes);
        }
        if (device.edits != document.edits) {
            device.edits.reset();  // of the scene as it is until this is whole
            updateScene(*device.scene, *device.base, document.edits);
            device.edits = document.edits;
            for (const auto& renderer : device.renderers) {
                if (renderer) renderer->noteSceneChange();
            }
            working_.scene = factsOf(*device.base, *device.shapes);
        }
        working_.problem.clear();
        return true;
    } catch (const DeviceError&) {
        throw;
    } catch (const Error& error) {
        // What was shown stays; the same order is not tried again.
        device.hasExtras = true;
        working_.problem = error.what();
        post();
        return false;
    }
}

}  // namespace kaustik::gui
