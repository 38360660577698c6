// SPDX-License-Identifier: MIT
// Where a light sees something specular, and nothing else, by cells of its view at every level up to
// the mask's finest: a bit a light. A cell's number is that of those of coarser levels and of those
// before it.
#include "framework/transport/types.h"

#ifdef MASK
layout(std430) readonly buffer SpecularMask {
    uvec2 specularMask[];  // x: somewhere in the cell; y: everywhere
};
#endif
uniform uint maskLevel;  // the finest

uint maskEntry(uint x, uint y, uint level) {
    return ((1u << (2u * level)) - 1u) / 3u + (y << level) + x;
}

bool isMasked(uint level) { return level <= maskLevel; }

#ifdef MASK
uvec2 maskOf(LightCell cell) {
    uint up = cell.level > maskLevel ? cell.level - maskLevel : 0u;
    uint light = cell.lightAndQuarters >> 8u;
    uvec2 mask = specularMask[maskEntry(cell.x >> up, cell.y >> up, cell.level - up)];
    return (mask >> light) & 1u;
}
#endif
