// SPDX-License-Identifier: MIT
// emit.deferred: photons from what lights see of fronts, at any place of their views (WN09, section
// 3.2): on a grid of emit.photons, or one for each cell that an adaptive driver asks for. Out:
// photons that arrive (flux in W) and the hits that they make; eye view space, m.
#include <fmt/format.h>

#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/deferred_buffers/deferred_buffers.h"
#include "techniques/photon_lists/emitted.h"

namespace kaustik {
namespace {

// A thread a photon, for each light in turn.
void dispatchOverLights(const FrameInputs& inputs, gl::PassContext& context, const Hits& hits,
                        const Geometry& geometry, const std::vector<DeferredBuffers>& buffers,
                        const DeferredParams& params, const Samples& samples, params::Extent grid,
                        bool onlyBeams) {
    const bool isList = samples.cells.valid();
    const CellGrid& cells = hits.incoming.cells;
    const int first = isList ? 0 : samples.firstLight;
    const int end = buffers.empty() ? 0
                    : isList        ? inputs.needs.photonLights
                                    : samples.firstLight + samples.lights;
    for (int light = first; light < end; ++light) {
        const DeferredBuffers& seen = buffers[static_cast<std::size_t>(light) % buffers.size()];
        gl::Command command =
            context.compute(onlyBeams ? "emit/deferred_beams.comp" : "emit/deferred.comp");
        if (isList) {
            command.define("CELL_LIST").storage("LightCells", samples.cells.cells);
        } else {
            command.set("gridSize", glm::ivec2(grid.width, grid.height))
                .set("firstRow", cells.firstRow)
                .set("rowsHere", cells.rows)
                .set("firstLight", samples.firstLight);
            if (!onlyBeams) command.set("ownRows", glm::ivec2(cells.firstOwn, cells.endOwn));
        }
        if (onlyBeams) {
            const Photons& photons = hits.incoming;
            command.texture("photonPosition", photons.position)
                .texture("photonDirection", photons.direction)
                .texture("photonFlux", photons.flux)
                .texture("startSurface", hits.surface)
                .storage("Photons", photons.list);
        }
        seen.views->bindTo(command);
        seen.bindTo(command);
        command.params("emit.deferred", params)
            .set("lightIndex", light)
            .storage("Instances", inputs.instances.instances)
            .set("lightFromEye", render::between(inputs.view, seen.views->view(0)));
        inputs.gpuScene.bindTriangles(command, geometry);
        dispatchOver(command, hits.incoming);
    }
}

Hits emitDeferred(FrameBuilder& frame, const DeferredParams& params, Surfaces surfaces,
                  Samples samples) {
    const std::vector<DeferredBuffers>& buffers = deferredBuffers(frame, surfaces.geometry);
    const bool isList = samples.cells.valid();
    const params::Extent grid = frame.photonsOfALight();
    const CellGrid cells = isList ? CellGrid{} : cellsOf(samples, grid);
    struct Data {
        Hits hits;
        Geometry geometry;
    };
    return frame
        .pass<Data>(
            "emit.deferred",
            isList ? "a photon for each cell of the lights' views that is asked for"
                   : fmt::format("{} photons a light, {} light{}", grid.width * grid.height,
                                 buffers.size(), buffers.size() == 1 ? "" : "s"),
            [&](graph::PassSetup& setup, Data& data) {
                data.geometry = surfaces.geometry;
                if (data.geometry.heightFields.valid()) setup.read(data.geometry.heightFields);
                for (const DeferredBuffers& seen : buffers)
                    seen.read(setup);
                if (isList) {
                    setup.read(samples.cells.cells);
                    setup.read(samples.cells.list);
                }
                const int width = isList ? samples.cells.width : grid.width;
                const int height = isList ? samples.cells.height : cells.rows * samples.lights;
                Photons photons = Photons::create(setup, width, height, samples.suffix,
                                                  {frame.usesBeams()}, samples.cells);
                photons.cells = cells;
                data.hits = storeEmitted(setup, photons, samples);
            },
            [&inputs = frame.inputs(), params, buffers, samples, grid](const Data& data,
                                                                       gl::PassContext& context) {
                const Photons& photons = data.hits.incoming;
                beginEmission(context, photons, samples);
                for (const bool onlyBeams : {false, true}) {
                    if (onlyBeams && !photons.hasBeams()) continue;
                    dispatchOverLights(inputs, context, data.hits, data.geometry, buffers, params,
                                       samples, grid, onlyBeams);
                }
            })
        .hits;
}

}  // namespace

void registerEmitDeferred(Registry& registry) {
    registry.node<EmitStage>(
        "deferred",
        {"Makes photons at any place of a light's view from fronts that are drawn once.",
         "WN09, sections 3.1 and 3.2",
         "What is thinner than a texel of emit.deferred.size is not found, which the ledger calls "
         "emission_sampling. A light that would have to see wider than 160 degrees emits nothing "
         "beyond that, and a warning says so."},
        {.beams = true, .emitsCells = true}, &emitDeferred);
}

}  // namespace kaustik
