// SPDX-License-Identifier: MIT
#include "techniques/shared/view_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace kaustik {
namespace {

bool overlap(const scene::Bounds& a, const scene::Bounds& b) {
    return !a.empty && !b.empty && glm::all(glm::lessThan(a.minimum, b.maximum)) &&
           glm::all(glm::lessThan(b.minimum, a.maximum));
}

bool contains(const scene::Bounds& outer, const scene::Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.minimum, inner.minimum)) &&
           glm::all(glm::greaterThanEqual(outer.maximum, inner.maximum));
}

// The longest chain of boxes, each within the one before.
int deepestNesting(std::vector<scene::Bounds> boxes) {
    const auto size = [](const scene::Bounds& box) {
        const glm::dvec3 extent = box.maximum - box.minimum;
        return extent.x + extent.y + extent.z;
    };
    std::sort(boxes.begin(), boxes.end(),
              [&](const auto& a, const auto& b) { return size(a) > size(b); });
    std::vector<int> depths(boxes.size(), 1);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t outer = 0; outer < i; ++outer) {
            if (contains(boxes[outer], boxes[i]))
                depths[i] = std::max(depths[i], depths[outer] + 1);
        }
    }
    return boxes.empty() ? 0 : *std::max_element(depths.begin(), depths.end());
}

}  // namespace

DielectricsBox boxOfDielectrics(const FrameBuilder& frame) {
    const scene::Scene& scene = frame.scene();
    scene::Bounds all;
    std::vector<scene::Bounds> closed;
    std::vector<scene::Bounds> others;
    for (const scene::Object& object : scene.objects) {
        const scene::MaterialKind kind = scene.materials[object.material].kind;
        const scene::Bounds bounds = objectBounds(scene, object);
        if (bounds.empty) continue;
        if (kind != scene::MaterialKind::dielectric) {
            others.push_back(bounds);
            continue;
        }
        all.include(bounds.minimum);
        all.include(bounds.maximum);
        if (scene.meshes[object.mesh].closed) closed.push_back(bounds);
    }
    DielectricsBox box;
    if (all.empty) return box;
    for (const scene::Bounds& inside : closed) {
        for (const scene::Bounds& other : others)
            box.holdsScene = box.holdsScene || overlap(inside, other);
    }
    box.nested = deepestNesting(closed);
    const render::RasterView& view = frame.view();
    const glm::dvec3 extent = all.maximum - all.minimum;
    const glm::dvec3 center(view.worldToView * glm::dvec4(0.5 * (all.minimum + all.maximum), 1.0));
    const double farthest = std::max(-center.z + 0.5 * glm::length(extent), view.nearMeters);
    const double margin = 1e-4 * glm::length(extent) + 2.0 * farthest * view.footprintPerMeter();
    box.centerVs = glm::vec3(center);
    box.halfExtentMeters = glm::vec3(0.5 * extent + margin);
    return box;
}

ViewPass declareLook(const FrameBuilder& frame, graph::PassSetup& setup,
                     const SceneLookParams& look, const EyeBuffer& eye,
                     const LayeredDepth& sceneLayers, const Radiance& receivers,
                     const Shadows& shadows) {
    setup.sample("interfaceDepth", eye.interface);
    setup.sample("interfaceSurface", eye.interfaceSurface);
    setup.sample("receiver", eye.receiver);
    setup.sample("receiverSurface", eye.receiverSurface);
    setup.sample("receiverRadiance", receivers.radiance);
    ViewPass pass;
    if (frame.needs().glossyReceivers && frame.needs().lights > 0) {
        pass.isGlossy = true;
        setup.sample("directVisibility", shadows.visibility);
    }
    if (look.surfaces == LookSurfaces::layers) {
        needsEyesView("surfaces=layers of a view", "the layers", sceneLayers.views);
        pass.sceneLayers = sceneLayers.layers;
        setup.sample("sceneDepths", sceneLayers.depth);
        setup.sample("sceneSurfaces", sceneLayers.surface);
    }
    const int w = frame.width();
    const int h = frame.height();
    pass.seen.radiance = setup.create<RadianceTexel>("view.radiance", w, h);
    pass.seen.exitPosition = setup.create<ExitPosition>("view.exit_position", w, h);
    pass.seen.exitDirection = setup.create<ExitDirection>("view.exit_direction", w, h);
    setup.bypass(pass.seen.radiance, receivers.radiance);
    setup.bypass(pass.seen.exitPosition, {0, 0, 0, 0});
    setup.bypass(pass.seen.exitDirection, {0, 0, 0, 0});
    return pass;
}

void setLook(const FrameInputs& inputs, gl::Command& command, const ViewPass& pass,
             const SceneLookParams& look) {
    command.set("looksIntoScene", look.scene ? 1 : 0)
        .set("reflectsScene", look.scene && look.reflection ? 1 : 0)
        .set("lookMirrors", look.mirrors)
        .target(pass.seen.radiance)
        .target(pass.seen.exitPosition)
        .target(pass.seen.exitDirection);
    if (inputs.needs.refractors > 0) command.define("DIELECTRICS");
    const bool looksInLayers = look.surfaces == LookSurfaces::layers;
    if (pass.isGlossy || looksInLayers) command.set("lightCount", inputs.needs.lights);
    if (pass.isGlossy) command.define("GLOSSY_RECEIVERS");
    if (looksInLayers) {
        command.define("LOOK_IN_LAYERS").set("sceneLayers", pass.sceneLayers);
    } else {
        command.set("lookStride", look.stride);
    }
}

std::size_t countExits(const gl::Texture& exitDirection, float ending) {
    const std::vector<float> texels = exitDirection.read();
    std::size_t count = 0;
    for (std::size_t i = 3; i < texels.size(); i += 4)
        count += texels[i] == ending ? 1 : 0;
    return count;
}

void keepToExitLimit(FrameBuilder& frame, const std::string& pass, const View& seen,
                     const std::string& parameter, const std::string& unit, int value, float ending,
                     const std::string& fate) {
    frame.keepsTo({pass,
                   {seen.exitDirection},
                   [=, exits = seen.exitDirection](
                       const gl::Executor& executor) -> std::optional<ReachedLimit> {
                       const std::size_t rays = countExits(executor.texture(exits), ending);
                       if (rays == 0) return {};
                       return ReachedLimit{
                           parameter,
                           unit,
                           static_cast<double>(value),
                           0.0,
                           fmt::format("the eye's rays of {} pixels {}", rays, fate),
                           0.0};
                   }});
}

void keepToMirrors(FrameBuilder& frame, const std::string& pass, const View& seen,
                   const SceneLookParams& look) {
    if (frame.needs().reflectors == 0) return;
    keepToExitLimit(frame, pass, seen, pass + ".mirrors", "mirrors", look.mirrors,
                    transport::kPathMirroredTooOften,
                    "hit one more mirror, in which they see the environment");
}

}  // namespace kaustik
