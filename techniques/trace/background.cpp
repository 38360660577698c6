// SPDX-License-Identifier: MIT
// trace.background: photons meet what their light sees of the receivers, by iteration in the
// light's depths (SP05; WD08, section 3). Each look gives the plane of a texel, and the next
// estimate is where the ray meets it; SP05's goes as far as the texel's surface is away. Only what
// lies on the surface in the end, by the residual, is a hit, unless a specular surface stops the
// light before (tracing/specular_ahead.h). Iteration may jump over what lies before, or end
// nowhere: the ray is searched in even steps for the first change from in front of what the light
// sees to behind it. In: photons, eye view space, m; out: hits, W that arrive after absorption.
// Misses: outside_map and hidden_in_map, or unresolved.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "framework/scene/triangles.h"
#include "techniques/raster_views/light_maps.h"
#include "techniques/tracing/specular_ahead.h"

namespace kaustik {
namespace {

enum class IterationStep : int { plane, distance };

struct BackgroundParams {
    int iterations = 4;
    IterationStep step = IterationStep::plane;
    int steps = 48;
    int refinements = 6;
    template <class R>
    void reflect(R& r) {
        r.field(iterations, "iterations", "Looks at the light's depths before the residual's test",
                "", params::range(1, 64));
        r.choice(step, "step",
                 "plane: to where the ray meets the plane of what is seen; distance: as far as "
                 "that is away (SP05)",
                 {"plane", "distance"});
        r.field(
            steps, "steps",
            "Even steps along the ray in which anything before what iteration has found, or where "
            "it has found nothing, is searched; 0: none, as published",
            "", params::range(0, 1024));
        r.field(refinements, "refinements", "Bisections of the step that the search has found", "",
                params::range(0, 32))
            .when(steps > 0, "with trace.background.steps=0");
    }
};

// Receivers that turn away from a light, on which its map cannot store anything.
std::vector<std::string> turnedAway(const scene::Scene& scene, const scene::Light& light) {
    std::vector<std::string> names;
    for (const scene::Object& object : scene.objects) {
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        if (!isReceiver(scene.materials[object.material].kind)) continue;
        double away = 0.0;
        double all = 0.0;
        for (const glm::uvec3& triangle : mesh.triangles) {
            const auto corners = scene::cornersOf(mesh, triangle, object.toWorld);
            const glm::dvec3 area =
                0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            const glm::dvec3 along = light.kind == scene::LightKind::directional
                                         ? light.direction
                                         : corners[0] - light.position;
            all += glm::length(area);
            if (glm::dot(area, along) > 0.0) away += glm::length(area);
        }
        if (away > 0.01 * all) names.push_back(object.name);
    }
    return names;
}

void warnHiddenReceivers(FrameBuilder& frame) {
    const auto said =
        frame.once<bool>("trace.background.said", [] { return std::make_shared<bool>(false); });
    if (*said) return;
    *said = true;
    for (const scene::Light& light : frame.scene().lights) {
        if (light.band > 0) continue;
        const std::vector<std::string> names = turnedAway(frame.scene(), light);
        if (names.empty()) continue;
        std::string list;
        for (const std::string& name : names)
            list += fmt::format("{}'{}'", list.empty() ? "" : ", ", name);
        frame.warn(fmt::format(
            "trace=background sees what light '{}' sees: this technique cannot form a path to the "
            "sides of {} that are turned away from it.",
            light.name, list));
    }
}

Hits traceBackground(FrameBuilder& frame, const BackgroundParams& params, Photons photons,
                     Surfaces surfaces) {
    warnHiddenReceivers(frame);
    const SpecularAhead ahead = findSpecularAhead(frame, photons, surfaces.geometry);
    const std::vector<ReceiverView>& lights = lightReceivers(frame, surfaces.geometry);
    Hits hits;
    for (std::size_t light = 0; light < lights.size(); ++light) {
        const ReceiverView& seen = lights[light];
        hits = frame.pass<Hits>(
            "trace.background", "photons look for their surface in the light's depths",
            [&](graph::PassSetup& setup, Hits& data) {
                photons.sample(setup);
                ahead.sample(setup);
                setup.sample("receiver", seen.receiver);
                setup.sample("receiverSurface", seen.receiverSurface);
                if (light == 0) {
                    data = Hits::create(setup, photons);
                } else {
                    data = hits;
                    data.rewrite(setup);
                }
                data.incoming.account(setup);
                data.store(setup);
            },
            [params, light, views = seen.views](const Hits& data, gl::PassContext& context) {
                gl::Command command = context.compute("trace/background.comp");
                views->bindTo(command)
                    .params("trace.background", params)
                    .set("lightIndex", static_cast<int>(light));
                dispatchOver(command, data.incoming);
            });
    }
    return hits;
}

}  // namespace

void registerTraceBackground(Registry& registry) {
    registry.node<TraceStage>(
        "background",
        {"Looks iteratively in the depths of each photon's light for the "
         "surface that it reaches.",
         "SP05; WD08, section 3",
         "It finds the first receiver that each photon's light sees, to a texel: sides that are "
         "turned away, what another receiver hides and what lies outside of the light's map are "
         "missed, as hidden_in_map and outside_map. Iteration may jump over thin surfaces between "
         "its even steps. It refuses photons inside of bodies, and of specular surfaces knows what "
         "trace.blockers shows it.",
         {"reconstruct.map_size", "reconstruct.map_covers", "reconstruct.map_memory"}},
        {.reach = TracerReach::lightFront, .onlyReceivers = true}, &traceBackground);
}

}  // namespace kaustik
