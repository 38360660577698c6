// SPDX-License-Identifier: MIT
// What a light sees first, found by Embree on all cores; there in builds with Embree alone.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "techniques/emit/grid_sight.h"
#include "techniques/tracing/processor_scene.h"

namespace kaustik {

// Of a band's rows, with those next to it; parts of those cells alone that something specular has
// its border in or next to.
struct SightOfRows {
    std::vector<SightOfCell> cells;
    std::vector<std::uint32_t> parts;
};

class TracesSight {
  public:
    explicit TracesSight(ProcessorScene scene) : scene_(std::move(scene)) {}
    void read(graph::PassSetup& setup) const { scene_.read(setup); }
    [[nodiscard]] SightOfRows find(const render::RasterView& light, const GridRows& rows,
                                   int band) const;

  private:
    ProcessorScene scene_;
};

}  // namespace kaustik
