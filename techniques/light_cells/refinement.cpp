// SPDX-License-Identifier: MIT
#include "techniques/light_cells/refinement.h"

#include <algorithm>
#include <cstddef>

#include "techniques/deferred_buffers/deferred_buffers.h"

namespace kaustik {
namespace {

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
            data.words = (buffers.size() + 31) / 32;
            for (const DeferredBuffers& seen : buffers)
                seen.read(setup);
            const std::size_t entries = ((std::size_t{1} << (2 * (finest + 1))) - 1) / 3;
            data.bits = setup.storage(
                "NextMask", setup.createBuffer<glm::uvec2>("adaptive.mask", entries * data.words));
        },
        [buffers](const SpecularMask& data, gl::PassContext& context) {
            const auto dispatch = [&](gl::Command command, int level) {
                command.set("level", static_cast<unsigned>(level))
                    .set("maskWords", static_cast<unsigned>(data.words))
                    .dispatchOver(1 << level, 8, 1 << level, 8);
            };
            for (std::size_t light = 0; light < buffers.size(); ++light) {
                gl::Command command = context.compute("light_cells/mask.comp");
                command.define("FINEST")
                    .texture("deferredSurface", buffers[light].surface)
                    .set("lightIndex", static_cast<int>(light))
                    .set("cellsOfView", glm::vec2(buffers[light].cells));
                dispatch(std::move(command), data.level);
            }
            for (int level = data.level - 1; level >= 0; --level)
                dispatch(context.compute("light_cells/mask.comp"), level);
        });
}

}  // namespace

std::shared_ptr<SpecularMask> specularMask(FrameBuilder& frame, const RefineParams& params,
                                           const CellTraversal& traversal) {
    if (params.mask == RefineSwitch::off) return nullptr;
    return frame.once<SpecularMask>("refine.mask", [&] {
        const FrameBuilder::PassScope within(frame, RefineStage::name);
        return std::make_shared<SpecularMask>(
            makeMask(frame, deferredBuffers(frame, traversal.geometry)));
    });
}

void declareRefinement(graph::PassSetup& setup, Refined& data, const CellTraversal& traversal,
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
    if (data.mask.bits.valid()) {
        command.set("maskLevel", static_cast<unsigned>(data.mask.level))
            .set("maskWords", static_cast<unsigned>(data.mask.words));
    }
}

void setCapacity(gl::Command& command, const TraversalSizes& sizes) {
    command.set("maxTaken", static_cast<unsigned>(sizes.round.capacity()))
        .set("maxPhotons", static_cast<unsigned>(sizes.photons.capacity()))
        .set("photonRow", static_cast<unsigned>(sizes.photons.width));
}

void overList(gl::Command& command, const LightCells& cells) {
    command.dispatchIndirect(cells.list, offsetof(transport::PhotonList, groupsX));
}

}  // namespace kaustik
