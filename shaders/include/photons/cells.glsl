// SPDX-License-Identifier: MIT
// The cells of lights' grids, or vertices, that photons stand for (CellGrid), and which photon of a
// list stands for each.
#include "framework/transport/types.h"

uniform ivec2 cellGrid;    // columns and rows
uniform int cellFirstRow;
uniform ivec2 cellLights;  // the first, and how many
uniform int cellSplits;

const uint kNoCell = 0xffffffffu;

// Column and row of a photon's cell, of those that the list holds of its light.
ivec2 cellOf(PhotonOrigin origin) {
    return ivec2(origin.cell % uint(cellGrid.x), origin.cell / uint(cellGrid.x)) -
           ivec2(0, cellFirstRow);
}

// Of a photon's cell and those next to it by so many; kNoCell where the grid has none. Photons that
// have taken another branch where both were followed are neighbours of their own.
uint cellPlace(PhotonOrigin origin, ivec2 neighbourOffset) {
    if (cellGrid.x == 0) return kNoCell;
    ivec2 at = cellOf(origin) + neighbourOffset;
    int light = int(origin.light) - cellLights.x;
    bool isIn = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, cellGrid)) && light >= 0 &&
                light < cellLights.y;
    if (!isIn) return kNoCell;
    int interactions = findMSB(origin.path);
    uint branch = bitfieldExtract(origin.path, max(interactions - cellSplits, 0), cellSplits);
    uint grid = branch * uint(cellLights.y) + uint(light);
    return (grid * uint(cellGrid.y) + uint(at.y)) * uint(cellGrid.x) + uint(at.x);
}
