// SPDX-License-Identifier: MIT
// Four neighbours whose light arrives on more than one surface: up to where, between them, each
// stands for what arrives. Where two surfaces meet in a crease, light comes down on whichever it
// reaches first, and the planes that the photons lie on say where that changes; elsewhere, at the
// silhouette of what is in front, half-way is the best that is known.
#include "reconstruct/triangles_neighbours.glsl"

// The share of the way from one corner to another that is the first one's.
float borderBetween(ArrivalsAround around, uint from, uint to) {
    Arrival a = around.corners[from];
    Arrival b = around.corners[to];
    vec2 step = stepBetween(from, to);
    // How far beyond the other's place each one's plane is.
    float atEnd = dot(a.position + a.spacing * step - b.position, b.direction);
    float atBegin = dot(b.position - b.spacing * step - a.position, a.direction);
    if (!(atBegin > 0.0) || !(atEnd > 0.0)) return 0.5;
    return clamp(atBegin / (atBegin + atEnd), 1.0 / 32.0, 31.0 / 32.0);
}

// What the photon at a corner stands for of the quadrilateral.
CellQuarter quarterAtCrease(ArrivalsAround around, uint own) {
    uint neighbour = own ^ 1u;
    uint above = own ^ 2u;
    uint across = own ^ 3u;
    bool isNeighbour = areTogether(around, own, neighbour);
    bool isAbove = areTogether(around, own, above);
    bool isAcross = (isNeighbour && areTogether(around, neighbour, across)) ||
                    (isAbove && areTogether(around, above, across));
    CellQuarter quarter = kWholeQuarter;
    if (!isNeighbour) quarter.along = borderBetween(around, own, neighbour);
    if (!isAbove) quarter.up = borderBetween(around, own, above);
    if (isNeighbour && isAbove) {
        if (!isAcross) quarter.across = vec2(borderBetween(around, own, across));
    } else if (isNeighbour && isAcross) {
        float there = borderBetween(around, neighbour, above);
        quarter.across = vec2(1.0 - there, there);
    } else if (isAbove && isAcross) {
        float there = borderBetween(around, above, neighbour);
        quarter.across = vec2(there, 1.0 - there);
    } else if (isNeighbour) {
        quarter.across.y = 0.5 * (quarter.up + borderBetween(around, neighbour, across));
    } else if (isAbove) {
        quarter.across.x = 0.5 * (quarter.along + borderBetween(around, above, across));
    } else {
        quarter.across = vec2(borderBetween(around, own, across));
    }
    return quarter;
}
