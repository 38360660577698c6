// SPDX-License-Identifier: MIT
// The cells that photons of emit.deferred are of: those of a list, or all of a grid's rows.
#include "include/photons/lights.glsl"
#include "deferred_buffers/deferred_surface.glsl"

#ifdef CELL_LIST
layout(std430) readonly buffer LightCells {
    LightCell lightCells[];
};
#else
uniform ivec2 gridSize;
uniform int firstRow;
uniform int rowsHere;
uniform int firstLight;
#endif
uniform int lightIndex;

struct CellOfLight {
    vec2 middle;    // from -1 to 1 across the view
    vec2 size;      // the same
    uint quarters;  // LightCell's; 0: all of it
    bool isOwn;    // of this light
    uint number;    // PhotonOrigin::cell
};

CellOfLight cellOfPhoton(uint index) {
    CellOfLight cell;
#ifdef CELL_LIST
    LightCell listed = lightCells[index];
    cell.size = vec2(2.0 / float(1u << listed.level));
    cell.middle = (vec2(listed.x, listed.y) + 0.5) * cell.size - 1.0;
    cell.quarters = listed.lightAndQuarters & 15u;
    cell.isOwn = int(listed.lightAndQuarters >> 8u) == lightIndex;
    // Whatever draws at random by it draws the same in every batch, for a probe of a cell as for
    // its photon.
    cell.number = (listed.y << 13u ^ listed.x) * 2654435761u + listed.level;
#else
    uint row = index / uint(gridSize.x);
    ivec2 at = ivec2(int(index % uint(gridSize.x)), int(row) + firstRow);
    cell.size = 2.0 / vec2(gridSize);
    cell.middle = (vec2(at) + 0.5) * cell.size - 1.0;
    cell.quarters = 0u;
    cell.isOwn = true;
    cell.number = uint(at.y) * uint(gridSize.x) + uint(at.x);
#endif
    return cell;
}

vec2 quarterOf(CellOfLight cell, int i) {
    return cell.middle + 0.25 * cell.size * (2.0 * vec2(i & 1, i >> 1) - 1.0);
}

// Where the cell's photon starts: in its middle, or, of one of some quarters alone whose light misses
// there, in the first of them that does not.
DeferredPoint pointOfCell(CellOfLight cell, bool onTriangles) {
    DeferredPoint point = pointAt(cell.middle, onTriangles);
    for (int i = 0; i < 4 && cell.quarters != 0u; ++i) {
        bool isSpecular = point.material != 0u && !isReceiver(materialKind(point.material - 1u));
        if (isSpecular) break;
        if ((cell.quarters & (1u << i)) != 0u) point = pointAt(quarterOf(cell, i), onTriangles);
    }
    return point;
}
