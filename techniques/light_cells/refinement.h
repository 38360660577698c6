// SPDX-License-Identifier: MIT
// What the nodes of stage `refine` share: which cells of a light's view become photons (WN09,
// sections 3.2.1 and 3.2.2).
#pragma once

#include <cstddef>
#include <memory>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/light_cells/cell_lists.h"
#include "techniques/light_cells/refine_stage.h"

namespace kaustik {

// Whether the light sees anything specular in a cell, for every cell of each level.
struct SpecularMask {
    graph::Buffer<glm::uvec2> bits;
    int level = 0;          // the finest
    std::size_t words = 1;  // of a cell: a bit a light
};

// The mask of all lights, made once a frame; null where refine.mask is off.
[[nodiscard]] std::shared_ptr<SpecularMask> specularMask(FrameBuilder& frame,
                                                         const RefineParams& params,
                                                         const CellTraversal& traversal);

// What both implementations declare and set.
struct Refined {
    CellTraversal traversal;
    SpecularMask mask;
    graph::Buffer<transport::LightCell> capturedCells;  // of refine.feedback
    graph::Buffer<transport::LightCell> capturedPhotons;
    graph::Buffer<glm::uvec2> capturedCounts;
};

// Declares what a pass reads and writes that decides on cells.
void declareRefinement(graph::PassSetup& setup, Refined& data, const CellTraversal& traversal,
                       const RefineParams& params, const std::shared_ptr<SpecularMask>& mask);
// Tells a command by what cells are judged, how many there is room for, and to run over a list.
void setDecision(gl::Command& command, const Refined& data, const TraversalSizes& sizes);
void setCapacity(gl::Command& command, const TraversalSizes& sizes);
void overList(gl::Command& command, const LightCells& cells);

}  // namespace kaustik
