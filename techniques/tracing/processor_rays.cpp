// SPDX-License-Identifier: MIT
#include "techniques/tracing/processor_rays.h"

#include <array>
#include <cmath>

#include "framework/reference/photon_audit.h"

namespace kaustik {
namespace {

// xyz: a normal, unit, outward, view space, and w: material + 1, or the distance, m; or xyz: a
// column of the matrix by which the shading normal turns, 1/m.
struct FoundTexel {
    static constexpr Format format = Format::rgba32f;
};

struct Found {
    Hits hits;
    graph::Texture<FoundTexel> shading;
    graph::Texture<FoundTexel> geometric;
    std::array<graph::Texture<FoundTexel>, 3> turning;  // invalid where photons have no beams
};

// A float holds words of the transfer map exactly.
std::uint32_t wordOf(float value) {
    return value >= 0.0f && value < 4.2e9f ? static_cast<std::uint32_t>(value) : 0u;
}

// In the eye's space.
std::vector<reference::AuditPhoton> raysOf(const Photons& photons, const render::RasterView& view,
                                           std::size_t count, int rows, gl::PassContext& context) {
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
        rays[i].reachMeters = 2.0 * view.footprintPerMeter() * std::abs(rays[i].position.z);
    }
    return rays;
}

void findHits(const render::RasterView& view, const reference::EmbreeScene& scene,
              const Found& found, gl::PassContext& context) {
    const Photons& photons = found.hits.incoming;
    const auto count = static_cast<std::size_t>(
        context.buffer(photons.list).read<transport::PhotonList>().front().count);
    const auto width = static_cast<std::size_t>(photons.width);
    const std::size_t rows = (count + width - 1) / width;
    const std::vector<reference::FirstHit> exact = reference::exactFirstHits(
        scene, raysOf(photons, view, count, static_cast<int>(rows), context),
        glm::inverse(view.worldToView));
    // What has hit nothing stays 0.
    const auto write = [&](const auto& texture, auto&& texelOf) {
        std::vector<glm::vec4> texels(rows * width, glm::vec4(0.0f));
        for (std::size_t i = 0; i < count; ++i)
            if (exact[i].exists()) texels[i] = glm::vec4(texelOf(exact[i]));
        context.texture(texture).writeRows(texels);
    };
    using Hit = reference::FirstHit;
    write(found.shading,
          [](const Hit& hit) { return glm::dvec4(hit.shadingNormal, hit.material); });
    write(found.geometric,
          [](const Hit& hit) { return glm::dvec4(hit.geometricNormal, hit.distanceMeters); });
    if (!photons.hasBeams()) return;
    for (int column = 0; column < 3; ++column)
        write(found.turning[static_cast<std::size_t>(column)],
              [column](const Hit& hit) { return glm::dvec4(hit.turning[column], 0.0); });
}

}  // namespace

Hits hitsByProcessor(FrameBuilder& frame, const Photons& photons) {
    const auto make = [&] { return std::make_shared<reference::EmbreeScene>(frame.scene()); };
    const char* const shared = "reference.embree_scene";
    const auto scene = frame.gpuScene().heightFields().empty()
                           ? frame.onceForScene<reference::EmbreeScene>(shared, make)
                           : frame.once<reference::EmbreeScene>(shared, make);
    return frame
        .pass<Found>(
            "trace.raytraced", "the processor traces every photon exactly",
            [&](graph::PassSetup& setup, Found& data) {
                photons.sample(setup);
                data.hits = Hits::create(setup, photons);
                data.hits.incoming.account(setup);
                data.hits.store(setup);
                const auto create = [&](const std::string& name) {
                    return setup.create<FoundTexel>(name + photons.suffix, photons.width,
                                                    photons.height);
                };
                data.shading = create("hits.shading");
                data.geometric = create("hits.geometric");
                if (!photons.hasBeams()) return;
                for (std::size_t column = 0; column < data.turning.size(); ++column)
                    data.turning[column] = create("hits.turning_" + std::to_string(column));
            },
            [&inputs = frame.inputs(), scene](const Found& data, gl::PassContext& context) {
                if (!context.isListing()) findHits(inputs.view, *scene, data, context);
                gl::Command command = context.compute("trace/raytraced.comp");
                command.texture("foundShading", data.shading)
                    .texture("foundGeometric", data.geometric);
                if (data.turning.front().valid()) {
                    command.texture("foundTurning0", data.turning[0])
                        .texture("foundTurning1", data.turning[1])
                        .texture("foundTurning2", data.turning[2]);
                }
                dispatchOver(command, data.hits.incoming);
            })
        .hits;
}

}  // namespace kaustik
