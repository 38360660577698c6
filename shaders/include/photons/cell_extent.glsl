// SPDX-License-Identifier: MIT
// What a photon stands for where its light's grid is lit in part: of its own cell and of cells
// next to it whose middles are dark, as far as the border of what the light sees is from the
// photon's place, told by sub-cells. At the border of a mesh's grid of vertices, or of a square that
// is refined: of nothing beyond.
// Four quarters, each a quadrilateral from the photon's place.

// Numbers in cells, away from the photon.
struct CellQuarter {
    float along;  // the corner on the axis u
    float up;     // the corner on the axis v
    vec2 across;  // the corner between
};
const CellQuarter kWholeQuarter = CellQuarter(0.5, 0.5, vec2(0.5));
const CellQuarter kNoQuarter = CellQuarter(0.0, 0.0, vec2(0.0));

// By the corner of the cell: right, up: bits.
vec2 sideOfQuarter(uint quarter) {
    return 2.0 * vec2(quarter & 1u, quarter >> 1u) - 1.0;
}

// Its area, as a share of a quarter of a cell.
float areaOf(CellQuarter quarter) {
    return 2.0 * (quarter.along * quarter.across.y + quarter.across.x * quarter.up);
}

// An extent's twelve numbers, in 32nds of a cell: the reach along the axes, right, up, left, down,
// and the corners between, a quarter after the other. 0: all of them are a half. A reach is 0 where
// there is nothing to stand for, beyond such a border.
uint inParts(float reach) {
    return reach > 0.0 ? uint(clamp(reach * 32.0 + 0.5, 1.0, 31.0)) : 0u;
}

uvec2 packedExtent(CellQuarter quarters[4]) {
    uvec2 extent = uvec2(0u);
    uvec2 corners[4];
    for (int i = 0; i < 4; ++i)
        corners[i] = uvec2(inParts(quarters[i].across.x), inParts(quarters[i].across.y));
    // A quarter that is nothing has no part in the axes that it shares.
    extent.x = inParts(max(quarters[3].along, quarters[1].along)) |
               inParts(max(quarters[3].up, quarters[2].up)) << 5u |
               inParts(max(quarters[0].along, quarters[2].along)) << 10u |
               inParts(max(quarters[0].up, quarters[1].up)) << 15u |
               corners[0].x << 20u | corners[0].y << 25u;
    for (int i = 1; i < 4; ++i)
        extent.y |= (corners[i].x | corners[i].y << 5u) << (10u * uint(i - 1));
    return extent;
}
CellQuarter unpackedQuarter(uvec2 extent, uint quarter) {
    if (extent == uvec2(0u)) return kWholeQuarter;
    uint along = (quarter & 1u) == 1u ? extent.x : extent.x >> 10u;
    uint up = quarter >= 2u ? extent.x >> 5u : extent.x >> 15u;
    uint corner = quarter == 0u ? extent.x >> 20u : extent.y >> (10u * (quarter - 1u));
    return CellQuarter(float(along & 31u) / 32.0, float(up & 31u) / 32.0,
                       vec2(corner & 31u, corner >> 5u & 31u) / 32.0);
}

// All of it, as a share of a cell.
float areaOfExtent(uvec2 extent) {
    float sum = 0.0;
    for (uint i = 0u; i < 4u; ++i) sum += 0.25 * areaOf(unpackedQuarter(extent, i));
    return sum;
}
