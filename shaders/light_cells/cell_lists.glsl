// SPDX-License-Identifier: MIT
// Lists of cells of lights' views, as the passes of an adaptive traversal have them.
#include "framework/transport/photon_list.h"
#include "framework/transport/types.h"

layout(std430) buffer CellCounting {
    CellCounts counting;
};

uint lightOf(LightCell cell) { return cell.lightAndQuarters >> 8u; }

LightCell quarterOfCell(LightCell cell, uint quarter) {
    return LightCell(2u * cell.x + (quarter & 1u), 2u * cell.y + (quarter >> 1u), cell.level + 1u,
                     cell.lightAndQuarters & ~15u);
}
