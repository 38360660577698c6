// SPDX-License-Identifier: MIT
// The squares between four photons of a light's grid whose light takes different ways: finer
// photons stand for it, (parts + 1) x (parts + 1) a square.
#pragma once

#include <cstdint>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Room for the photons of one round.
struct SquareRoom {
    int parts = 1;  // along a side of a square, odd
    int perRow = 1;
    int rows = 0;
    [[nodiscard]] int photonsOfSquare() const { return (parts + 1) * (parts + 1); }
    [[nodiscard]] int capacity() const { return perRow * rows; }
};
[[nodiscard]] SquareRoom squareRoom(const FrameBuilder& frame, int parts, int lights);
// How the photons of so many squares are told apart as cells.
[[nodiscard]] CellGrid cellsOfSquares(const SquareRoom& room, const Samples& samples);

struct RefinedSquares {
    graph::Buffer<std::uint32_t> flags;        // Samples::refined
    graph::Buffer<transport::LightCell> list;  // of all of the batch
    graph::Buffer<transport::CellCounts> counts;
};

// Follows a batch's photons without storing anything, and lists the squares of whose light more
// than `share` arrives where reconstruct.triangles would not join it.
[[nodiscard]] RefinedSquares findRefined(FrameBuilder& frame, const Surfaces& surfaces,
                                         const Samples& samples, float share,
                                         graph::Buffer<transport::CellCounts> counts);

// The samples of the next round of them.
struct SquareRound {
    LightCells squares;
    graph::Buffer<transport::CellCounts> counts;
};
[[nodiscard]] SquareRound takeSquares(FrameBuilder& frame, const RefinedSquares& refined,
                                      const SquareRoom& room, const std::string& suffix);

}  // namespace kaustik
