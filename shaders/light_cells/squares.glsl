// SPDX-License-Identifier: MIT
// Squares between four photons of a batch's grids (Samples::refined): those around the photons of
// the cells, so one more along each side.
#include "include/photons/cells.glsl"

// The square that a quarter of a photon's cell, by the corner of the cell, lies in.
uint squareOf(PhotonOrigin origin, uint quarter) {
    ivec2 at = cellOf(origin) + ivec2(quarter & 1u, quarter >> 1u);
    int row = (int(origin.light) - cellLights.x) * (cellGrid.y + 1) + at.y;
    return uint(row * (cellGrid.x + 1) + at.x);
}

// Shares of a square's flux are summed in parts of so many.
const float kSquareParts = 1048576.0;
