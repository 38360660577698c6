// SPDX-License-Identifier: MIT
// Squares between four photons of a light's grid that finer photons stand for: one at each corner of
// the `refinement` by `refinement` parts, whose middles are the middles of the cells of a grid so
// many times as fine. A square has all of them for itself, so that what lies in it is whole. In the
// list they follow square by square; as cells (CellGrid), by which neighbours are found, squares lie
// in rows with a row and a column without photons between them.
#include "framework/transport/types.h"

layout(std430) readonly buffer LightCells {
    LightCell lightCells[];  // x, y: the cell at the upper right of the square
};
uniform int refinement;       // odd
uniform int squaresPerRow;
uniform int squareRows;       // that there is room for
uniform int firstLightOfBatch;

struct PlaceInSquare {
    uint square;   // of the list
    ivec2 corner;  // of the parts, from 0 to refinement
    int light;     // -1: there is no such square
};

PlaceInSquare placeInSquare(uint photon) {
    uint corners = uint(refinement + 1);
    uint square = photon / (corners * corners);
    uint corner = photon % (corners * corners);
    int light = square < uint(squaresPerRow * squareRows)
                    ? int(lightCells[square].lightAndQuarters >> 8u) - 1 : -1;
    return PlaceInSquare(square, ivec2(corner % corners, corner / corners), light);
}

// Of the fine grid.
ivec2 cellInSquare(PlaceInSquare place) {
    if (place.light < 0) return ivec2(0);
    ivec2 coarse = ivec2(lightCells[place.square].x, lightCells[place.square].y) - 1;
    return coarse * refinement + refinement / 2 + place.corner;
}

ivec2 texelInList(PlaceInSquare place) {
    int corners = refinement + 1;
    int photon = int(place.square) * corners * corners + place.corner.y * corners + place.corner.x;
    int rowLength = squaresPerRow * corners * corners;
    return ivec2(photon % rowLength, photon / rowLength);
}

ivec2 placeInCellGrid(PlaceInSquare place) {
    ivec2 square = ivec2(int(place.square) % squaresPerRow, int(place.square) / squaresPerRow);
    return square * (refinement + 2) + place.corner;
}

// PhotonOrigin::cell
uint numberInList(PlaceInSquare place) {
    ivec2 at = placeInCellGrid(place);
    return uint(at.y * (squaresPerRow * (refinement + 2)) + at.x);
}

ivec2 extentTexelOf(PlaceInSquare place) {
    int rows = squareRows * (refinement + 2);
    return placeInCellGrid(place) + ivec2(0, (place.light - firstLightOfBatch) * rows);
}

// Whether a quarter of a photon's cell lies next to the square.
bool isBeyondSquare(PlaceInSquare place, uint quarter) {
    ivec2 side = ivec2(quarter & 1u, quarter >> 1u);
    return any(equal(place.corner, side * refinement));
}
