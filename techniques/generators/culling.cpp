// SPDX-License-Identifier: MIT
#include "techniques/generators/culling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/pipeline/effect.h"
#include "techniques/generators/generators.h"
#include "techniques/generators/light_reach.h"

namespace kaustik {
namespace {

double radiusOf(const scene::Bounds& bounds) {
    return 0.5 * glm::length(bounds.maximum - bounds.minimum);
}

// Whether direct light may come to a ball around the box; true where that is not certain.
bool mayLight(const scene::Light& light, const scene::Bounds& bounds) {
    if (light.kind == scene::LightKind::directional) return true;
    const glm::dvec3 offset = 0.5 * (bounds.minimum + bounds.maximum) - light.position;
    const double distance = glm::length(offset);
    const double radius = radiusOf(bounds);
    const auto range = static_cast<double>(light.rangeMeters);
    if (range > 0.0 && distance - radius > range) return false;
    if (light.kind != scene::LightKind::spot || distance <= radius) return true;
    const double angle =
        std::acos(std::clamp(glm::dot(offset, light.direction) / distance, -1.0, 1.0));
    return angle - std::asin(radius / distance) <= static_cast<double>(light.outerConeRadians);
}

CulledObjects findCulled(FrameBuilder& frame) {
    const scene::Scene& scene = frame.scene();
    const GeneratorCulling cull = frame.params<GeneratorParams>("around").cull;
    CulledObjects culled;
    if (cull == GeneratorCulling::none || !whyNoEffect(frame.facts(), "around.cull").empty())
        return culled;
    const std::vector<bool> isSeen = cull == GeneratorCulling::eye
                                         ? mayReachPicture(scene, frame.view())
                                         : std::vector<bool>(scene.objects.size(), true);
    const auto leaveOut = [&](std::size_t object, std::vector<std::size_t>& list,
                              const char* reason) {
        list.push_back(object);
        frame.skip(fmt::format("around.'{}'", scene.objects[object].name), reason);
    };
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const scene::Object& object = scene.objects[i];
        const scene::Bounds bounds = objectBounds(scene, object);
        if (isReceiver(scene.materials[object.material].kind) || bounds.empty) continue;
        const bool isLit =
            std::any_of(scene.lights.begin(), scene.lights.end(),
                        [&](const scene::Light& light) { return mayLight(light, bounds); });
        if (!isSeen[i])
            leaveOut(i, culled.unseen, "its light comes to nothing that the eye sees");
        else if (!isLit)
            leaveOut(i, culled.unlit, "no light reaches it directly");
    }
    return culled;
}

// As shaders/generators/unseen.comp has it: boxes along the world's axes, from the eye, m.
struct UnseenBox {
    glm::vec4 center;
    glm::vec4 halfExtent;
};

struct UnseenBoxes {
    gl::Buffer buffer;
    glm::mat3 eyeToWorld;
};

UnseenBoxes boxesOf(FrameBuilder& frame, const std::vector<std::size_t>& objects) {
    const glm::dmat4 toWorld = glm::inverse(frame.view().worldToView);
    const glm::dvec3 eye(toWorld[3]);
    std::vector<UnseenBox> boxes;
    for (const std::size_t object : objects) {
        const scene::Bounds box = objectBounds(frame.scene(), frame.scene().objects[object]);
        boxes.push_back({glm::vec4(0.5 * (box.minimum + box.maximum) - eye, 0.0),
                         glm::vec4(0.5 * (box.maximum - box.minimum), 0.0)});
    }
    return {gl::Buffer(boxes, "unseen_boxes"), glm::mat3(glm::dmat3(toWorld))};
}

}  // namespace

const CulledObjects& culledObjects(FrameBuilder& frame) {
    return *frame.once<CulledObjects>(
        "generators.culled", [&] { return std::make_shared<CulledObjects>(findCulled(frame)); });
}

Hits endAtUnseen(FrameBuilder& frame, const Hits& hits) {
    const std::vector<std::size_t>& unseen = culledObjects(frame).unseen;
    if (unseen.empty()) return hits;
    const UnseenBoxes& boxes = *frame.once<UnseenBoxes>("generators.unseen_boxes", [&] {
        return std::make_shared<UnseenBoxes>(boxesOf(frame, unseen));
    });
    return frame.pass<Hits>(
        "around.cull",
        fmt::format("light on {} specular object{} comes to nothing that the eye sees",
                    unseen.size(), unseen.size() == 1 ? "" : "s"),
        [&](graph::PassSetup& setup, Hits& data) {
            hits.sample(setup);
            data = hits;
            hits.incoming.sample(setup);
            data.incoming.account(setup);
            data.flux = setup.image(
                "keptFlux", setup.create<HitFlux>("hits.kept" + hits.incoming.suffix,
                                                  hits.incoming.width, hits.incoming.height));
        },
        [&boxes, count = static_cast<int>(unseen.size())](const Hits& data,
                                                          gl::PassContext& context) {
            gl::Command command = context.compute("generators/unseen.comp");
            command.storage("UnseenBoxes", boxes.buffer)
                .set("boxCount", count)
                .set("eyeToWorld", boxes.eyeToWorld);
            dispatchOver(command, data.incoming);
        });
}

}  // namespace kaustik
