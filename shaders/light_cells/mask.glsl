// SPDX-License-Identifier: MIT
// Where a light sees something specular, and nothing else, by cells of its view at every level up to
// the mask's finest: a bit a light, 32 of them a word. A cell's number is that of those of coarser
// levels and of those before it.
#include "include/surfaces/bands.glsl"
#include "framework/transport/types.h"

#ifdef MASK
layout(std430) readonly buffer SpecularMask {
    uvec2 specularMask[];  // x: somewhere in the cell; y: everywhere
};
#endif
uniform uint maskLevel;  // the finest
uniform uint maskWords;  // of a cell

// Where the words of a cell begin.
uint maskEntry(uint x, uint y, uint level) {
    return (((1u << (2u * level)) - 1u) / 3u + (y << level) + x) * maskWords;
}

bool isMasked(uint level) { return level <= maskLevel; }

#ifdef MASK
uvec2 maskOf(LightCell cell) {
    uint up = cell.level > maskLevel ? cell.level - maskLevel : 0u;
    uint light = lightOfBand(cell.lightAndQuarters >> 8u);
    uint entry = maskEntry(cell.x >> up, cell.y >> up, cell.level - up);
    return (specularMask[entry + light / 32u] >> (light % 32u)) & 1u;
}
#endif
