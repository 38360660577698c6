// SPDX-License-Identifier: MIT
// How large the lists of an adaptive traversal are, and how deep it goes.
#pragma once

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/light_cells/refine_stage.h"

namespace kaustik {

// Room for photons, probes or cells, in rows.
struct ListCapacity {
    int width = 0;
    int height = 0;
    [[nodiscard]] int capacity() const { return width * height; }
};

struct TraversalSizes {
    int startLevel = 5;    // of the cells that wait at the start
    int checkLevel = 9;    // of the first probes of which a metric is asked
    int finestLevel = 12;  // of the last
    ListCapacity photons;
    ListCapacity probes;
    ListCapacity round;  // cells that are taken at once: a quarter of the probes
};

// ConfigError where a number of cells is no power of two.
[[nodiscard]] TraversalSizes sizesOf(const FrameBuilder& frame, const RefineParams& params);

}  // namespace kaustik
