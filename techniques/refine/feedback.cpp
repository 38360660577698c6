// SPDX-License-Identifier: MIT
// refine.feedback: which cells of a light's view become photons, the paper's way: a point a cell,
// of which a geometry shader sends what becomes of it to two streams (WN09, section 4). Gives the
// same lists as refine.compute.
#include <cstddef>

#include "techniques/light_cells/refinement.h"

namespace kaustik {
namespace {

CellTraversal refineByFeedback(FrameBuilder& frame, const params::NoParams&,
                               CellTraversal traversal) {
    const auto& params = frame.params<RefineParams>("refine");
    const TraversalSizes sizes = sizesOf(frame, params);
    const std::shared_ptr<SpecularMask> mask = specularMask(frame, params, traversal);
    const auto maximum = static_cast<std::size_t>(sizes.probes.capacity());
    return frame
        .pass<Refined>(
            "refine.feedback", "cells are dropped, split, or become photons",
            [&](graph::PassSetup& setup, Refined& data) {
                declareRefinement(setup, data, traversal, params, mask);
                data.capturedCells = setup.storage(
                    "CapturedCells", setup.createBuffer<transport::LightCell>(
                                         "adaptive.captured_cells" + traversal.suffix, maximum));
                data.capturedPhotons =
                    setup.storage("CapturedPhotons",
                                  setup.createBuffer<transport::LightCell>(
                                      "adaptive.captured_photons" + traversal.suffix, maximum));
                data.capturedCounts = setup.storage(
                    "CapturedCounts",
                    setup.createBuffer<glm::uvec2>("adaptive.captured" + traversal.suffix, 1));
            },
            [sizes](const Refined& data, gl::PassContext& context) {
                const CellTraversal& t = data.traversal;
                gl::Command capture =
                    context.shaders({"refine/feedback.vert", "refine/feedback.geom"});
                setDecision(capture, data, sizes);
                capture.captureIndirect(
                    GL_POINTS, t.taken.list, offsetof(transport::PhotonList, vertices),
                    {data.capturedCells, data.capturedPhotons}, data.capturedCounts);
                gl::Command append = context.compute("refine/feedback_append.comp");
                overList(append, t.probes);
                gl::Command close = context.compute("refine/feedback_close.comp");
                setCapacity(close, sizes);
                close.dispatch(1);
            })
        .traversal;
}

}  // namespace

void registerRefineFeedback(Registry& registry) {
    registry.node<RefineStage>(
        "feedback",
        {"As refine.compute, by a geometry shader, whose two streams transform feedback captures.",
         "WN09, section 4",
         "It gives the same lists as refine.compute and shares its limits. It needs a device whose "
         "geometry shaders have two streams that transform feedback captures."},
        &refineByFeedback);
}

}  // namespace kaustik
