// SPDX-License-Identifier: MIT
// What a light sees first through the cells of its grid and parts of them, for emit.grid: drawn, or
// found by the processor's rays where the device is the processor itself.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "framework/pipeline/frame_builder.h"
#include "techniques/photon_lists/emitted.h"
#include "techniques/raster_views/light_sight.h"

namespace kaustik {

// Most parts of a light's view that are looked at together.
inline constexpr int kMaxSight = 4194304;

// Cells of a batch: rows of the grids, with those next to it that its own are to be joined with.
struct GridRows {
    params::Extent grid;
    CellGrid cells;
    int subcells = 1;
    // What a light sees is found in bands of the grid's rows that no batch has a part in: a
    // rasteriser rounds by where in its window a triangle lies.
    [[nodiscard]] int bandRows() const {
        return std::clamp(kMaxSight / (grid.width * subcells * subcells), 1, grid.height);
    }
    // A cell's extent depends on what the light sees no farther than two cells away.
    [[nodiscard]] int firstSeen(int band) const { return band * bandRows() - 2; }
    [[nodiscard]] int seen() const { return bandRows() + 4; }
    [[nodiscard]] int firstBand() const { return cells.firstRow / bandRows(); }
    [[nodiscard]] int endBand() const { return (cells.firstRow + cells.rows - 1) / bandRows() + 1; }
    // The rows of the batch that a band has.
    [[nodiscard]] int firstIn(int band) const {
        return std::max(cells.firstRow, band * bandRows());
    }
    [[nodiscard]] int rowsIn(int band) const {
        return std::min(cells.firstRow + cells.rows, (band + 1) * bandRows()) - firstIn(band);
    }
};

// Through each part of a cell. x: object's index + 1, 0 none; y: the triangle.
struct SightOfLight {
    static constexpr Format format = Format::rg32ui;
};

// Through the middle of a cell (four words: include/photons/light_grid.glsl).
struct SightOfCell {
    std::uint32_t object = 0;  // index + 1; 0: none
    std::uint32_t triangle = 0;
    // 1 + where the objects of its parts begin among `GridSight::parts`, the lower row first; 0:
    // all of them are the cell's own.
    std::uint32_t parts = 0;
    std::uint32_t unused = 0;
};

// Who finds it.
enum class SightBy : int { automatic, raster, processor };

class TracesSight;

struct GridSight {
    // Drawn.
    graph::Texture<SightOfLight> drawn;
    graph::Texture<DepthBuffer> depth;
    // Traced: cells by rows, and objects, index + 1.
    graph::Buffer<SightOfCell> cells;
    graph::Buffer<std::uint32_t> parts;
};

// Makes a GridSight for a pass, and fills it for one light and band after the other.
class SightFinder {
  public:
    // ConfigError where the processor is asked for and the program is built without Embree.
    SightFinder(FrameBuilder& frame, SightBy by, bool isOfSquares, const Geometry& geometry);
    [[nodiscard]] bool isTraced() const { return traces_ != nullptr; }
    [[nodiscard]] GridSight create(graph::PassSetup& setup, const GridRows& rows,
                                   const std::string& suffix) const;
    void find(const FrameInputs& inputs, gl::PassContext& context, const GridSight& sight,
              const Geometry& geometry, const LightSight& seen, const GridRows& rows,
              int band) const;
    // For shaders that include include/photons/light_grid.glsl.
    static void bind(gl::Command& command, const GridSight& sight, const GridRows& rows, int band);

  private:
    std::shared_ptr<const TracesSight> traces_;  // null: drawn
};

}  // namespace kaustik
