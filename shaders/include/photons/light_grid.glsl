// SPDX-License-Identifier: MIT
// Cells of a light's grid and what the light sees first through each (techniques/emit/grid_sight.h),
// by sub-cells, an odd number a cell's side. A compute thread a cell.
#include "include/photons/light_triangle.glsl"
#include "include/photons/lights.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef SIGHT_OF_CELLS
uniform usamplerBuffer sightOfCells;  // SightOfCell
uniform usamplerBuffer sightOfParts;  // objects, index + 1
uniform int sightRows;                // that there are cells of
#else
uniform usampler2D sight;  // SightOfLight
#endif
uniform int subcells;       // a side of a cell
uniform int sightFirstRow;  // of the grid, of which `sight` begins to hold cells
uniform ivec2 gridSize;     // cells
uniform vec2 halfExtent;    // of the grid, m, or tangents of the half-angles
uniform int lightIndex;
uniform ivec2 cellsHere;   // columns and rows of this light in the list
uniform int firstRow;      // of the grid, in the list
uniform int firstOfLight;  // row of the list where this light's begin

// Where the threads are those of a list, 64 a workgroup.
uint threadOfList() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u +
           gl_LocalInvocationIndex;
}

#ifdef REFINED_SQUARES
#include "include/photons/refined_square.glsl"

// The cell of this thread, and its texel in the list; false: there is none for it.
bool cellOfThread(out ivec2 cell, out ivec2 texel) {
    PlaceInSquare place = placeInSquare(threadOfList());
    cell = cellInSquare(place);
    texel = texelInList(place);
    // What lies beyond the grid is of the first band or the last, which leave it empty.
    int row = clamp(cell.y, 0, gridSize.y - 1) - firstRow;
    return place.light == lightIndex && row >= 0 && row < cellsHere.y;
}
#else
#ifdef LISTED_CELLS
// emit/grid_list.comp's: how many, and from the fifth on column + 65536 row of each.
uniform usamplerBuffer listedCells;
#endif

// The cell of this thread, and its texel in the list; false: there is none for it.
bool cellOfThread(out ivec2 cell, out ivec2 texel) {
#ifdef LISTED_CELLS
    uint number = threadOfList();
    bool isOne = number < texelFetch(listedCells, 0).x;
    uint place = texelFetch(listedCells, isOne ? int(number) + 4 : 0).x;
    ivec2 here = ivec2(place & 0xffffu, place >> 16u);
#else
    ivec2 here = ivec2(gl_GlobalInvocationID.xy);
    bool isOne = all(lessThan(here, cellsHere));
#endif
    cell = here + ivec2(0, firstRow);
    texel = here + ivec2(0, firstOfLight);
    return isOne;
}
#endif

#ifdef SIGHT_OF_CELLS
// Of the cells of which something is known; -1: it is none.
int numberOfSeenCell(ivec2 cell) {
    int row = cell.y - sightFirstRow;
    bool isIn = cell.x >= 0 && cell.x < gridSize.x && row >= 0 && row < sightRows;
    return isIn ? row * gridSize.x + cell.x : -1;
}
#else
uvec2 seenThroughPart(ivec2 cell, ivec2 neighbourOffset) {
    ivec2 texel = (cell - ivec2(0, sightFirstRow)) * subcells + subcells / 2 + neighbourOffset;
    ivec2 size = textureSize(sight, 0);
    bool isIn = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, size));
    return isIn ? texelFetch(sight, texel, 0).xy : uvec2(0u);
}
#endif

// What the light sees through the middle of a cell. x: object's index + 1, 0 where nothing is or the
// grid has ended; y: the triangle.
uvec2 seenThrough(ivec2 cell) {
#ifdef SIGHT_OF_CELLS
    int number = numberOfSeenCell(cell);
    return number >= 0 ? texelFetch(sightOfCells, number).xy : uvec2(0u);
#else
    return seenThroughPart(cell, ivec2(0));
#endif
}

// The object, index + 1, through the middle of the sub-cell that lies so many next to the middle of
// the cell.
uint objectThrough(ivec2 cell, ivec2 neighbourOffset) {
#ifdef SIGHT_OF_CELLS
    ivec2 part = subcells / 2 + neighbourOffset;
    // No more than a few cells away: exact.
    ivec2 away = ivec2(floor((vec2(part) + 0.5) / float(subcells)));
    int number = numberOfSeenCell(cell + away);
    if (number < 0) return 0u;
    uvec4 seen = texelFetch(sightOfCells, number);
    if (seen.z == 0u) return seen.x;
    ivec2 inCell = part - away * subcells;
    return texelFetch(sightOfParts, int(seen.z) - 1 + inCell.y * subcells + inCell.x).x;
#else
    return seenThroughPart(cell, neighbourOffset).x;
#endif
}

vec2 sizeOfCell() { return 2.0 * halfExtent / vec2(gridSize); }

// Where the light's ray through the middle of a cell is, m, or the tangents of its angles.
vec2 placeOfCell(ivec2 cell) {
    return (2.0 * (vec2(cell) + 0.5) / vec2(gridSize) - 1.0) * halfExtent;
}
