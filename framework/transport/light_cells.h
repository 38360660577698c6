// SPDX-License-Identifier: MIT
// Parts of lights' views, cell by cell, that adaptive photons are emitted by (WN09, section 3.2).
#pragma once

#include "framework/graph/graph.h"
#include "framework/transport/types.h"

namespace kaustik {

// A list of cells of lights' views, which only the device can count. Photons of a list have the
// texels of their cells.
struct LightCells {
    graph::Buffer<transport::LightCell> cells;
    graph::Buffer<transport::PhotonList> list;
    int width = 0;  // room for width x height
    int height = 0;
    [[nodiscard]] bool valid() const { return cells.valid(); }
    [[nodiscard]] int capacity() const { return width * height; }
};

}  // namespace kaustik
