// SPDX-License-Identifier: MIT
// The cells of lights' grids, or vertices, that photons stand for (CellGrid), and which photon of a
// list stands for each.
#include "framework/transport/types.h"

uniform ivec2 cellGrid;    // columns and rows
uniform int cellFirstRow;
uniform ivec2 cellOwnRows; // of the grid, from and before: see isFromOtherBatch
uniform ivec2 cellLights;  // the first, and how many
uniform int cellSplits;

const uint kNoCell = 0xffffffffu;

// Column and row of a photon's cell, of those that the list holds of its light.
ivec2 cellOf(PhotonOrigin origin) {
    return ivec2(origin.cell % uint(cellGrid.x), origin.cell / uint(cellGrid.x)) -
           ivec2(0, cellFirstRow);
}

// Whether another batch of emission brings a photon as well, and here it is only to be joined with.
bool isFromOtherBatch(PhotonOrigin origin) {
    if (cellGrid.x == 0) return false;
    int row = int(origin.cell / uint(cellGrid.x));
    return row < cellOwnRows.x || row >= cellOwnRows.y;
}

// Of the photon with that number, of those that are of one cell, in a photon's cell or one that lies
// so many next to it; kNoCell where the grid has none.
uint cellPlaceOf(PhotonOrigin origin, ivec2 neighbourOffset, uint number) {
    if (cellGrid.x == 0) return kNoCell;
    ivec2 at = cellOf(origin) + neighbourOffset;
    int light = int(origin.light) - cellLights.x;
    bool isIn = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, cellGrid)) && light >= 0 &&
                light < cellLights.y;
    if (!isIn || number >= 1u << cellSplits) return kNoCell;
    uint grid = number * uint(cellLights.y) + uint(light);
    return (grid * uint(cellGrid.y) + uint(at.y)) * uint(cellGrid.x) + uint(at.x);
}

// Of the photon itself.
uint cellPlace(PhotonOrigin origin) {
    return cellPlaceOf(origin, ivec2(0), origin.branch & 0xffu);
}
