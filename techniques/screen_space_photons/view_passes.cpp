// SPDX-License-Identifier: MIT
#include "techniques/screen_space_photons/view_passes.h"

#include <algorithm>
#include <vector>

namespace kaustik {
namespace {

bool overlap(const scene::Bounds& a, const scene::Bounds& b) {
    return !a.empty && !b.empty && glm::all(glm::lessThan(a.minimum, b.maximum)) &&
           glm::all(glm::lessThan(b.minimum, a.maximum));
}

}  // namespace

DielectricsBox boxOfDielectrics(const FrameBuilder& frame) {
    const scene::Scene& scene = frame.scene();
    scene::Bounds all;
    std::vector<scene::Bounds> closed;
    std::vector<scene::Bounds> receivers;
    for (const scene::Object& object : scene.objects) {
        const scene::MaterialKind kind = scene.materials[object.material].kind;
        if (kind == scene::MaterialKind::mirror) continue;
        const scene::Bounds bounds = objectBounds(scene, object);
        if (bounds.empty) continue;
        if (isReceiver(kind)) {
            receivers.push_back(bounds);
            continue;
        }
        all.include(bounds.minimum);
        all.include(bounds.maximum);
        if (scene.meshes[object.mesh].closed) closed.push_back(bounds);
    }
    DielectricsBox box;
    if (all.empty) return box;
    for (const scene::Bounds& inside : closed) {
        for (const scene::Bounds& receiver : receivers)
            box.holdsReceivers = box.holdsReceivers || overlap(inside, receiver);
    }
    const render::EyeView& view = frame.view();
    const glm::dvec3 extent = all.maximum - all.minimum;
    const glm::dvec3 center(view.worldToView * glm::dvec4(0.5 * (all.minimum + all.maximum), 1.0));
    const double farthest = std::max(-center.z + 0.5 * glm::length(extent), view.nearMeters);
    const double margin = 1e-4 * glm::length(extent) + 2.0 * farthest * view.footprintPerMeter();
    box.centerVs = glm::vec3(center);
    box.halfExtentMeters = glm::vec3(0.5 * extent + margin);
    return box;
}

View createView(const FrameBuilder& frame, graph::PassSetup& setup, const EyeBuffer& eye,
                const Radiance& receivers) {
    setup.read(eye.interface);
    setup.read(eye.interfaceSurface);
    setup.read(eye.receiver);
    setup.read(eye.receiverSurface);
    setup.read(receivers.radiance);
    const int w = frame.width();
    const int h = frame.height();
    View view;
    view.radiance = setup.create<RadianceTexel>("view.radiance", w, h);
    view.exitPosition = setup.create<ExitPosition>("view.exit_position", w, h);
    view.exitDirection = setup.create<ExitDirection>("view.exit_direction", w, h);
    setup.bypass(view.radiance, receivers.radiance);
    setup.bypass(view.exitPosition, {0, 0, 0, 0});
    setup.bypass(view.exitDirection, {0, 0, 0, 0});
    return view;
}

std::size_t countExits(const gl::Texture& exitDirection, float ending) {
    const std::vector<float> texels = exitDirection.read();
    std::size_t count = 0;
    for (std::size_t i = 3; i < texels.size(); i += 4)
        count += texels[i] == ending ? 1 : 0;
    return count;
}

void bindLook(const FrameInputs& inputs, gl::Command& command, const EyeBuffer& eye,
              const Radiance& receivers, const SceneLookParams& look, const View& seen) {
    command.texture("sceneImages", inputs.gpuScene.images())
        .texture("interfaceDepth", eye.interface)
        .texture("interfaceSurface", eye.interfaceSurface)
        .texture("receiver", eye.receiver)
        .texture("receiverSurface", eye.receiverSurface)
        .texture("receiverRadiance", receivers.radiance)
        .set("looksIntoScene", look.scene ? 1 : 0)
        .set("mirrorsScene", look.scene && look.reflection ? 1 : 0)
        .set("lookStride", look.stride)
        .target(seen.radiance)
        .target(seen.exitPosition)
        .target(seen.exitDirection);
}

}  // namespace kaustik
