// SPDX-License-Identifier: MIT
// Which cells of a light's view become photons (WN09, sections 3.2.1 and 3.2.2). refine.compute:
// one thread a cell decides, a prefix scan keeps the order of both lists. refine.feedback: the
// paper's way, a point a cell, of which a geometry shader sends what becomes of it to two streams.
// Both give the same lists.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/adaptive_caustic_map/cell_lists.h"
#include "techniques/adaptive_caustic_map/deferred_buffers.h"
#include "techniques/adaptive_caustic_map/nodes.h"

namespace kaustik {
namespace {

struct SpecularMask {
    graph::Buffer<glm::uvec2> bits;
    int level = 0;  // the finest
};

// No finer than the lights' texels, nor than what a few megabytes hold.
constexpr int kFinestMask = 11;

SpecularMask makeMask(FrameBuilder& frame, const std::vector<DeferredBuffers>& buffers) {
    const int side = frame.params<DeferredParams>("emit.deferred").size;
    int finest = 0;
    while (finest < kFinestMask && (2 << finest) <= side)
        ++finest;
    return frame.pass<SpecularMask>(
        "mask", "cells in which a light sees nothing specular are dropped at once",
        [&](graph::PassSetup& setup, SpecularMask& data) {
            data.level = finest;
            for (const DeferredBuffers& seen : buffers)
                seen.read(setup);
            const std::size_t entries = ((std::size_t{1} << (2 * (finest + 1))) - 1) / 3;
            data.bits =
                setup.storage("NextMask", setup.createBuffer<glm::uvec2>("adaptive.mask", entries));
        },
        [buffers](const SpecularMask& data, gl::PassContext& context) {
            const auto dispatch = [&](gl::Command command, int level) {
                command.set("level", static_cast<unsigned>(level))
                    .dispatchOver(1 << level, 8, 1 << level, 8);
            };
            for (std::size_t light = 0; light < buffers.size(); ++light) {
                gl::Command command = context.compute("adaptive_caustic_map/mask.comp");
                command.define("FINEST")
                    .texture("deferredSurface", buffers[light].surface)
                    .set("lightIndex", static_cast<int>(light))
                    .set("cellsOfView", glm::vec2(buffers[light].cells));
                dispatch(std::move(command), data.level);
            }
            for (int level = data.level - 1; level >= 0; --level)
                dispatch(context.compute("adaptive_caustic_map/mask.comp"), level);
        });
}

// What both implementations declare and set.
struct Refined {
    CellTraversal traversal;
    SpecularMask mask;
    graph::Buffer<transport::LightCell> capturedCells;  // of refine.feedback
    graph::Buffer<transport::LightCell> capturedPhotons;
    graph::Buffer<glm::uvec2> capturedCounts;
};

std::shared_ptr<SpecularMask> maskFor(FrameBuilder& frame, const RefineParams& params,
                                      const CellTraversal& traversal) {
    if (params.mask == RefineSwitch::off) return nullptr;
    return frame.once<SpecularMask>("refine.mask", [&] {
        const FrameBuilder::Within within(frame, RefineStage::name);
        return std::make_shared<SpecularMask>(
            makeMask(frame, deferredBuffers(frame, traversal.geometry)));
    });
}

void declare(graph::PassSetup& setup, Refined& data, const CellTraversal& traversal,
             const RefineParams& params, const std::shared_ptr<SpecularMask>& mask) {
    CellTraversal& t = data.traversal;
    t = traversal;
    t.counts = setup.storage("CellCounting", setup.write(traversal.counts));
    t.waiting = setup.storage("WaitingCells", setup.write(traversal.waiting));
    t.photons.cells = setup.storage("PhotonCells", setup.write(traversal.photons.cells));
    t.photons.list = setup.storage("PhotonCellList", setup.write(traversal.photons.list));
    setup.storage("TakenCells", traversal.taken.cells);
    setup.read(traversal.taken.list);
    setup.storage("ProbeList", traversal.probes.list);
    setup.sample("hitFlux", traversal.first.flux);
    if (traversal.landings.valid()) {
        setup.storage("Landings", traversal.landings);
        setup.define("LANDINGS");
    }
    if (params.signature == RefineSwitch::on) setup.define("SIGNATURES");
    if (!mask) return;
    data.mask = *mask;
    setup.storage("SpecularMask", mask->bits);
    setup.define("MASK");
}

void setDecision(gl::Command& command, const Refined& data, const TraversalSizes& sizes) {
    const CellTraversal& t = data.traversal;
    command.set("checkLevel", static_cast<unsigned>(t.checkLevel))
        .set("finestLevel", static_cast<unsigned>(sizes.finestLevel));
    if (t.landings.valid()) command.set("branches", t.branches).set("tolerance", t.tolerance);
    if (data.mask.bits.valid()) command.set("maskLevel", static_cast<unsigned>(data.mask.level));
}

void setRoom(gl::Command& command, const TraversalSizes& sizes) {
    command.set("mostTaken", static_cast<unsigned>(sizes.round.capacity()))
        .set("mostPhotons", static_cast<unsigned>(sizes.photons.capacity()))
        .set("photonRow", static_cast<unsigned>(sizes.photons.width));
}

void overList(gl::Command& command, const LightCells& cells) {
    command.dispatchIndirect(cells.list, offsetof(transport::PhotonList, groupsX));
}

CellTraversal refineByCompute(FrameBuilder& frame, const params::NoParams&,
                              CellTraversal traversal) {
    const auto& params = frame.params<RefineParams>("refine");
    const TraversalSizes sizes = sizesOf(frame, params);
    const std::shared_ptr<SpecularMask> mask = maskFor(frame, params, traversal);
    const auto cells = static_cast<std::size_t>(sizes.round.capacity());
    return frame
        .pass<Refined>(
            "refine.compute", "cells are dropped, split, or become photons",
            [&](graph::PassSetup& setup, Refined& data) {
                declare(setup, data, traversal, params, mask);
                setup.storage("Decisions", setup.createBuffer<std::uint32_t>(
                                               "adaptive.decisions" + traversal.suffix, cells));
                setup.storage("GroupFirsts",
                              setup.createBuffer<glm::uvec2>("adaptive.firsts" + traversal.suffix,
                                                             (cells + 63) / 64));
            },
            [sizes](const Refined& data, gl::PassContext& context) {
                gl::Command decide = context.compute("adaptive_caustic_map/refine_decide.comp");
                setDecision(decide, data, sizes);
                overList(decide, data.traversal.taken);
                gl::Command offsets = context.compute("adaptive_caustic_map/refine_offsets.comp");
                setRoom(offsets, sizes);
                offsets.dispatch(1);
                gl::Command place = context.compute("adaptive_caustic_map/refine_place.comp");
                overList(place, data.traversal.taken);
            })
        .traversal;
}

CellTraversal refineByFeedback(FrameBuilder& frame, const params::NoParams&,
                               CellTraversal traversal) {
    const auto& params = frame.params<RefineParams>("refine");
    const TraversalSizes sizes = sizesOf(frame, params);
    const std::shared_ptr<SpecularMask> mask = maskFor(frame, params, traversal);
    const auto most = static_cast<std::size_t>(sizes.probes.capacity());
    return frame
        .pass<Refined>(
            "refine.feedback", "cells are dropped, split, or become photons",
            [&](graph::PassSetup& setup, Refined& data) {
                declare(setup, data, traversal, params, mask);
                data.capturedCells = setup.storage(
                    "CapturedCells", setup.createBuffer<transport::LightCell>(
                                         "adaptive.captured_cells" + traversal.suffix, most));
                data.capturedPhotons = setup.storage(
                    "CapturedPhotons", setup.createBuffer<transport::LightCell>(
                                           "adaptive.captured_photons" + traversal.suffix, most));
                data.capturedCounts = setup.storage(
                    "CapturedCounts",
                    setup.createBuffer<glm::uvec2>("adaptive.captured" + traversal.suffix, 1));
            },
            [sizes](const Refined& data, gl::PassContext& context) {
                const CellTraversal& t = data.traversal;
                gl::Command capture =
                    context.shaders({"adaptive_caustic_map/refine_feedback.vert",
                                     "adaptive_caustic_map/refine_feedback.geom"});
                setDecision(capture, data, sizes);
                capture.captureIndirect(
                    GL_POINTS, t.taken.list, offsetof(transport::PhotonList, vertices),
                    {data.capturedCells, data.capturedPhotons}, data.capturedCounts);
                gl::Command append = context.compute("adaptive_caustic_map/refine_append.comp");
                overList(append, t.probes);
                gl::Command close = context.compute("adaptive_caustic_map/refine_close.comp");
                setRoom(close, sizes);
                close.dispatch(1);
            })
        .traversal;
}

}  // namespace

void registerRefinement(Registry& registry) {
    registry.node<RefineStage>(
        "compute",
        {"Decides on every cell by a compute thread; a prefix scan keeps the order of cells and "
         "photons.",
         "WN09, sections 3.2.1 and 3.2.2"},
        &refineByCompute);
    registry.node<RefineStage>(
        "feedback",
        {"The same by a geometry shader, whose two streams transform feedback captures.",
         "WN09, section 4"},
        &refineByFeedback);
}

}  // namespace kaustik
