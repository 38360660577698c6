// SPDX-License-Identifier: MIT
// Lists the squares of a batch that are to be refined, in their order. Step 0 decides and counts, a
// thread a row of squares; step 1, one thread, says where each row's begin; step 2 lists them: by the
// cell at the upper right of the square, and with the light + 1, so that 0 is none.
#include "include/thread.glsl"
#include "light_cells/cell_lists.glsl"
#include "light_cells/squares.glsl"

uniform int listStep;
uniform float refineShare;  // of a square's light

layout(std430) readonly buffer PartedShares {
    uint partedShares[];
};
layout(std430) buffer RefinedFlags {
    uint refinedFlags[];
};
layout(std430) buffer SquareRows {
    uint squareRowCounts[];
};
layout(std430) writeonly buffer RefinedSquares {
    LightCell refinedSquares[];
};

// Of the grid: the row of cells below the squares, -1 below its first.
int rowBelow(uint row) { return int(row) % (cellGrid.y + 1) - 1 + cellFirstRow; }

// Squares between two batches are of the one that has the photons below.
bool isOwnRow(uint row) {
    int below = rowBelow(row);
    return (below >= cellOwnRows.x && below < cellOwnRows.y) || (below < 0 && cellOwnRows.x == 0);
}

void main() {
    uint rows = uint((cellGrid.y + 1) * cellLights.y);
    uint row = threadNumber();
    if (listStep == 1) {
        if (row > 0u) return;
        uint sum = 0u;
        for (uint i = 0u; i < rows; ++i) {
            uint count = squareRowCounts[i];
            squareRowCounts[i] = sum;
            sum += count;
        }
        counting.waiting = sum;
        counting.photons = 0u;
        return;
    }
    if (row >= rows) return;
    uint columns = uint(cellGrid.x + 1);
    uint next = listStep == 0 ? 0u : squareRowCounts[row];
    int light = cellLights.x + int(row) / (cellGrid.y + 1);
    for (uint x = 0u; x < columns; ++x) {
        uint square = row * columns + x;
        if (listStep == 0)
            refinedFlags[square] = float(partedShares[square]) > refineShare * kSquareParts ? 1u : 0u;
        if (refinedFlags[square] == 0u || !isOwnRow(row)) continue;
        if (listStep == 2)
            refinedSquares[next] = LightCell(x, uint(rowBelow(row) + 1), 0u, uint(light + 1) << 8u);
        ++next;
    }
    if (listStep == 0) squareRowCounts[row] = next;
}
