// SPDX-License-Identifier: MIT
#include "techniques/tracing/processor_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "framework/reference/photon_audit.h"
#include "techniques/tracing/processor_scene.h"

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

// Rows of the list's textures, a texel a photon.
using Texels = std::vector<glm::vec4>;

struct Rays {
    Texels position, direction, flux;
    [[nodiscard]] bool isOnItsWay(std::size_t i) const {
        return wordOf(direction[i].w) == transport::kFateInFlight;
    }
    // In the eye's space.
    [[nodiscard]] reference::AuditPhoton photon(const render::RasterView& view,
                                                std::size_t i) const {
        // Where an open mirror sent it on may be known to a pixel alone.
        const double reach =
            2.0 * view.footprintPerMeter() * std::abs(static_cast<double>(position[i].z));
        return {glm::dvec3(position[i]), glm::dvec3(direction[i]), wordOf(flux[i].w), reach};
    }
};

// What has hit nothing stays 0.
struct FoundTexels {
    Texels shading, geometric;
    std::array<Texels, 3> turning;
};

void findHits(const render::RasterView& view, const reference::EmbreeScene& scene,
              const Found& found, gl::PassContext& context) {
    const Photons& photons = found.hits.incoming;
    const auto count = static_cast<std::size_t>(
        context.buffer(photons.list).read<transport::PhotonList>().front().count);
    const auto width = static_cast<std::size_t>(photons.width);
    const std::size_t rows = (count + width - 1) / width;
    const auto read = [&](const auto& texture) {
        return context.texture(texture).readRows(static_cast<int>(rows));
    };
    const Rays rays{read(photons.position), read(photons.direction), read(photons.flux)};
    const Texels nothing(rows * width, glm::vec4(0.0f));
    FoundTexels texels{nothing, nothing, {}};
    if (photons.hasBeams()) texels.turning.fill(nothing);
    const reference::FirstHits hits(scene, glm::inverse(view.worldToView));
    const auto find = [&](std::size_t i) {
        if (!rays.isOnItsWay(i)) return;
        const reference::FirstHit hit = hits.of(rays.photon(view, i));
        if (!hit.exists()) return;
        texels.shading[i] = glm::vec4(hit.shadingNormal, hit.material);
        texels.geometric[i] = glm::vec4(hit.geometricNormal, hit.distanceMeters);
        // A receiver bends no beam.
        const bool bends = !isReceiver(scene.scene().materials[hit.material - 1].kind);
        if (!photons.hasBeams() || !bends) return;
        const glm::mat3 turning(hits.turningAt(hit));
        for (int column = 0; column < 3; ++column)
            texels.turning[static_cast<std::size_t>(column)][i] = glm::vec4(turning[column], 0.0f);
    };
    // Few enough at once that the last ones are shared out too.
    constexpr std::size_t kAtOnce = 256;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kAtOnce),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              find(i);
                      });
    const auto write = [&](const auto& texture, const Texels& from) {
        context.texture(texture).writeRows(from);
    };
    write(found.shading, texels.shading);
    write(found.geometric, texels.geometric);
    if (!photons.hasBeams()) return;
    for (std::size_t column = 0; column < 3; ++column)
        write(found.turning[column], texels.turning[column]);
}

}  // namespace

Hits hitsByProcessor(FrameBuilder& frame, const Photons& photons, const Geometry& geometry) {
    const ProcessorScene processor = processorScene(frame, geometry);
    return frame
        .pass<Found>(
            "trace.raytraced", "the processor traces every photon exactly",
            [&](graph::PassSetup& setup, Found& data) {
                photons.sample(setup);
                processor.read(setup);
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
            [&inputs = frame.inputs(), scene = processor.scene](const Found& data,
                                                                gl::PassContext& context) {
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
