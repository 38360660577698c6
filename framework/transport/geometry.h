// SPDX-License-Identifier: MIT
// The handle of geometry that is made on the device in each frame.
#pragma once

#include "framework/graph/graph.h"
#include "framework/transport/types.h"

namespace kaustik {

// Vertices that are made on the GPU each frame; invalid where the scene has none.
struct Geometry {
    graph::Buffer<transport::VertexData> heightFields;
};

}  // namespace kaustik
