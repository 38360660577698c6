// SPDX-License-Identifier: MIT
// trace.raytraced: the exact first hit of every photon, by Embree on all cores of the processor:
// what somebody without a graphics card would use, and the tracer that judges any reconstruction
// without an error of its own. The list is read back, and what was found is written to the device.
// In: photons, eye view space, m; out: hits, W that arrive after absorption. It sees what no view
// shows, and reads no layers.
#include <cmath>

#include "framework/pipeline/frame_builder.h"
#include "framework/reference/photon_audit.h"

namespace kaustik {
namespace {

struct FoundNormal {  // xyz: unit, outward, view space; w: material + 1, or the distance, m
    static constexpr Format format = Format::rgba32f;
};

struct Found {
    Hits hits;
    graph::Texture<FoundNormal> shading;
    graph::Texture<FoundNormal> geometric;
    // Columns of the matrix by which the shading normal turns, 1/m; where photons have beams.
    graph::Texture<HitShape> turning;  // three times as many rows
};

// A float holds words of the transfer map exactly.
std::uint32_t wordOf(float value) {
    return value >= 0.0f && value < 4.2e9f ? static_cast<std::uint32_t>(value) : 0u;
}

void findHits(const FrameInputs& inputs, const reference::EmbreeScene& scene, const Found& found,
              gl::PassContext& context) {
    const Photons& photons = found.hits.incoming;
    const auto count = static_cast<std::size_t>(
        context.buffer(photons.list).read<transport::PhotonList>().front().count);
    const auto width = static_cast<std::size_t>(photons.width);
    const int rows = static_cast<int>((count + width - 1) / width);
    const std::vector<glm::vec4> position = context.texture(photons.position).readRows(rows);
    const std::vector<glm::vec4> direction = context.texture(photons.direction).readRows(rows);
    const std::vector<glm::vec4> flux = context.texture(photons.flux).readRows(rows);
    std::vector<reference::AuditPhoton> rays(count);
    for (std::size_t i = 0; i < count; ++i) {
        // One that is not on its way is no ray.
        if (wordOf(direction[i].w) != transport::kFateInFlight) continue;
        rays[i].position = glm::dvec3(position[i]);
        rays[i].direction = glm::dvec3(direction[i]);
        rays[i].media = wordOf(flux[i].w);
        // Where an open mirror sent it on may be known to a pixel alone.
        rays[i].reachMeters = 2.0 * inputs.view.footprintPerMeter() * std::abs(rays[i].position.z);
    }
    const std::vector<reference::FirstHit> exact =
        reference::exactFirstHits(scene, rays, glm::inverse(inputs.view.worldToView));
    std::vector<glm::vec4> shading(position.size(), glm::vec4(0.0f));
    std::vector<glm::vec4> geometric(position.size(), glm::vec4(0.0f));
    for (std::size_t i = 0; i < count; ++i) {
        if (!exact[i].exists()) continue;
        shading[i] = glm::vec4(glm::dvec4(exact[i].shadingNormal, exact[i].material));
        geometric[i] = glm::vec4(glm::dvec4(exact[i].geometricNormal, exact[i].distanceMeters));
    }
    context.texture(found.shading).writeRows(shading);
    context.texture(found.geometric).writeRows(geometric);
    if (!photons.hasBeams()) return;
    std::vector<glm::vec4> turning(3 * position.size(), glm::vec4(0.0f));
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t row = i / width;
        for (int column = 0; exact[i].exists() && column < 3; ++column) {
            const std::size_t at = (3 * row + static_cast<std::size_t>(column)) * width + i % width;
            turning[at] = glm::vec4(glm::dvec4(exact[i].turning[column], 0.0));
        }
    }
    context.texture(found.turning).writeRows(turning);
}

Hits traceRaytraced(FrameBuilder& frame, const params::NoParams&, Photons photons,
                    Surfaces /*surfaces*/) {
    const auto scene = frame.once<reference::EmbreeScene>("reference.embree_scene", [&] {
        return std::make_shared<reference::EmbreeScene>(frame.scene());
    });
    return frame
        .pass<Found>(
            "trace.raytraced", "the processor traces every photon exactly",
            [&](graph::PassSetup& setup, Found& data) {
                photons.sample(setup);
                data.hits = Hits::create(setup, photons);
                data.hits.incoming.account(setup);
                data.hits.store(setup);
                const auto create = [&](const char* name) {
                    return setup.create<FoundNormal>(name + photons.suffix, photons.width,
                                                     photons.height);
                };
                data.shading = create("hits.shading");
                data.geometric = create("hits.geometric");
                if (!photons.hasBeams()) return;
                data.turning = setup.create<HitShape>("hits.turning" + photons.suffix,
                                                      photons.width, 3 * photons.height);
            },
            [&inputs = frame.inputs(), scene](const Found& data, gl::PassContext& context) {
                if (!context.isListing()) findHits(inputs, *scene, data, context);
                gl::Command command = context.compute("trace/raytraced.comp");
                command.texture("foundShading", data.shading)
                    .texture("foundGeometric", data.geometric);
                if (data.turning.valid()) command.texture("foundTurning", data.turning);
                dispatchOver(command, data.hits.incoming);
            })
        .hits;
}

}  // namespace

void registerTraceRaytraced(Registry& registry) {
    registry.node<TraceStage>(
        "raytraced",
        {"Exact first hits by ray tracing on the processor (Embree).", "",
         "It runs on the processor and reads the list of photons back for it, so that the device "
         "waits. It is there only in builds with Embree."},
        {.reach = TracerReach::everything, .texelRows = 3}, &traceRaytraced);
}

}  // namespace kaustik
