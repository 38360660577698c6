// SPDX-License-Identifier: MIT
// emit.grid: photons on a regular grid of each light's view (K06, section 1.1; the
// render-to-vertex- buffer caustics of the time), where they first hit a specular surface. The
// grid is the tightest rectangle around the specular objects; one grid a light, stacked in the
// transfer map. Out: photons that arrive (flux in W) and the hits that they make; eye view space,
// m.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/shared/light_sight.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

void addBeams(gl::PassContext& context, const Photons& photons, int light, const LightSight& seen,
              params::Extent grid, const render::RasterView& eye) {
    const glm::vec2 texels(grid.width, grid.height);
    dispatchOver(context.compute("shared/emit_beams.comp")
                     .texture("photonPosition", photons.position)
                     .texture("photonDirection", photons.direction)
                     .texture("photonFlux", photons.flux)
                     .texture("photonOrigin", photons.origin)
                     .storage("Photons", photons.list)
                     .image("nextBeamPlace", photons.beamPlace)
                     .image("nextBeamTurn", photons.beamTurn)
                     .set("lightIndex", light)
                     .set("texelSize", 2.0f * glm::vec2(seen.view.halfExtent) / texels)
                     .set("lightToEye", glm::mat3(render::between(seen.view, eye))),
                 photons);
}

Hits emitGrid(FrameBuilder& frame, const params::NoParams&, Surfaces surfaces, Samples samples) {
    const params::Extent grid = frame.params<EmitParams>("emit").photons;
    // The same for every batch.
    const auto grids = frame.once<std::vector<LightSight>>("emit.grids", [&frame] {
        return std::make_shared<std::vector<LightSight>>(sightsOfSpecular(frame));
    });
    // Cells beside a batch are known to it where they are to be joined with.
    const int beside = frame.joinsCells() ? 1 : 0;
    const int first = std::max(samples.firstRow - beside, 0);
    const int rows = std::min(samples.firstRow + samples.rows + beside, grid.height) - first;
    struct Data {
        Hits hits;
        graph::Texture<DepthBuffer> depth;
        Geometry geometry;
    };
    const std::string why =
        grids->empty() ? "keeps the transfer map empty: no light, or nothing specular"
                       : fmt::format("{} photons a light, {} light{}", grid.width * grid.height,
                                     grids->size(), grids->size() == 1 ? "" : "s");
    return frame
        .pass<Data>(
            "emit.grid", why,
            [&](graph::PassSetup& setup, Data& data) {
                data.geometry = surfaces.geometry;
                if (data.geometry.heightFields.valid()) setup.read(data.geometry.heightFields);
                Photons photons = Photons::create(setup, grid.width, rows * samples.lights,
                                                  samples.suffix, frame.usesBeams());
                photons.batch = samples.suffix;
                photons.cells = {grid.width, first, rows, samples.firstLight, samples.lights, 0};
                photons.ledger = samples.ledger.valid()
                                     ? setup.write(samples.ledger)
                                     : setup.createBuffer<transport::LedgerEntry>(
                                           "ledger", transport::kAccountCount);
                data.hits = Hits::create(setup, photons);
                data.depth = setup.create<DepthBuffer>("emit.depth_buffer" + samples.suffix,
                                                       grid.width, rows * samples.lights);
            },
            [&inputs = frame.inputs(), grids, grid, samples, first, rows](
                const Data& data, gl::PassContext& context) {
                const Photons& photons = data.hits.incoming;
                if (!samples.ledger.valid()) context.buffer(photons.ledger).clear();
                fillList(context, photons);
                const auto addTargets = [&](gl::Command& command, bool clear) {
                    const auto add = [&](const graph::ResourceRef& handle) {
                        command.target(handle);
                        if (clear) command.clear();
                    };
                    add(photons.position);
                    add(photons.direction);
                    add(photons.flux);
                    add(photons.origin);
                    for (const graph::ResourceRef& texture : data.hits.textures())
                        add(texture);
                    command.depth(data.depth, gl::DepthTest::nearerReversed);
                    if (clear) command.clear();
                };
                if (grids->empty()) {
                    for (const std::vector<graph::ResourceRef>& textures :
                         {photons.textures(), data.hits.textures()}) {
                        for (const graph::ResourceRef& texture : textures)
                            context.texture(texture).clear({0, 0, 0, 0});
                    }
                }
                const int end =
                    std::min(samples.firstLight + samples.lights, static_cast<int>(grids->size()));
                for (int light = samples.firstLight; light < end; ++light) {
                    const LightSight& seen = (*grids)[static_cast<std::size_t>(light)];
                    // The rows of the batch are those that fall into the target.
                    const int bottom = (light - samples.firstLight) * rows - first;
                    const auto ownRows = glm::vec2(bottom + samples.firstRow,
                                                   bottom + samples.firstRow + samples.rows);
                    gl::Command command =
                        context.shaders({"shared/emit_grid.vert", "shared/emit_grid.frag"});
                    addTargets(command, light == samples.firstLight);
                    command.viewport(0, bottom, grid.width, grid.height)
                        .storage("LightInstances", seen.instances->instances)
                        .set("projection", seen.view.projection())
                        .set("lightIndex", light)
                        .set("halfExtent", glm::vec2(seen.view.halfExtent))
                        .set("gridSize", glm::vec2(grid.width, grid.height))
                        .set("gridBottom", static_cast<float>(bottom))
                        .set("ownRows", ownRows);
                    inputs.gpuScene.draw(command, context, data.geometry, inputs.instances,
                                         render::DrawSet::all);
                }
                for (int light = samples.firstLight; photons.hasBeams() && light < end; ++light) {
                    addBeams(context, photons, light, (*grids)[static_cast<std::size_t>(light)],
                             grid, inputs.view);
                }
            })
        .hits;
}

}  // namespace

void registerGridEmission(Registry& registry) {
    registry.node<EmitStage>("grid",
                             {.sentence = "Rasterises the specular surfaces from each light, one "
                                          "photon a texel.",
                              .source = "K06, section 1.1",
                              .beams = true},
                             &emitGrid);
}

}  // namespace kaustik
