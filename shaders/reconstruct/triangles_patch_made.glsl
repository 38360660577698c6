// SPDX-License-Identifier: MIT
// The patches that reconstruct.triangles covers:
//   JOINED_PATCHES  of the photons at their corners
//   CREASE_PATCHES  of one photon's beam, as far as it goes to where surfaces meet
//   or else of one photon's beam
#include "include/photons/arriving.glsl"
#include "include/surfaces/surface_data.glsl"
#include "reconstruct/triangles_crease.glsl"
#include "reconstruct/triangles_patch.glsl"
#include "reconstruct/triangles_patch_list.glsl"

PatchSide sideOf(vec3 normal, vec3 direction, uint material) {
    return PatchSide(normal, direction, isOpen(material - 1u) && dot(normal, direction) > 0.0);
}

// What a beam covers between four places, in cells from its own and none farther than `farthest`
// along either axis.
Patch patchOfBeam(Arrival at, vec2 ends[4], float farthest) {
    vec3 extent = farthest * (abs(at.spacing[0]) + abs(at.spacing[1]));
    // In front of the view, and of bounded size on the screen.
    float scale = 1.0;
#ifdef MANY_VIEWS
    float depth = length(at.position);
    float widest = 2.0 * length(extent) / pixelFootprint(depth);
#else
    float depth = -at.position.z;
#ifndef ORTHOGRAPHIC_VIEW
    float room = 0.5 * (depth - view.frustum.z);
    if (extent.z > room) scale = max(room, 0.0) / extent.z;
#endif
    float widest = 2.0 * max(extent.x, extent.y) / pixelFootprint(depth);
#endif
    float largest = float(reconstruct_triangles_maximum);
    Patch made;
    made.isJoined = false;
    made.isAlone = false;
    made.narrowing = 1.0;
    if (widest * scale > largest) {
        scale = largest / widest;
        made.narrowing = widest / largest;
    }
    mat2x3 spacing = at.spacing * scale;
    for (int i = 0; i < 4; ++i) made.corners[i] = at.position + spacing * ends[i];
    made.densities = float[4](1.0, 1.0, 1.0, 1.0);
    made.first = 0.5;
    made.side = sideOf(at.normal, at.direction, at.material);
    made.flux = at.flux;
    made.tolerance = 0.25 * scale * length(extent);
#ifdef LIGHT_SPREAD
    made.spread = mat2x3[4](at.spread, at.spread, at.spread, at.spread);
    made.cellArea = length(cross(at.spacing[0], at.spacing[1]));
#endif
    return made;
}

layout(std430) readonly buffer PhotonShares {
    VertexShares photonShares[];
};

// Twice the area of the triangle, m².
float twiceArea(vec3 a, vec3 b, vec3 c) {
    return length(cross(b - a, c - a));
}

// Irradiance at the corners by the areas of all triangles there (U08, section 4.2): a photon's flux
// is shared out among them as they are large, so that the flux between three corners is their
// triangle's area by a third of what each has over all of its own; linear between the corners. Where
// none has any area, in equal parts.
void shareByAreas(inout Patch made, uint photonsOf[4]) {
    // By the same numbers as those round the vertices were.
    vec3 corners[4];
    for (int i = 0; i < 4; ++i)
        corners[i] = texelFetch(hitPosition, ivec2(photonTexel(photons, photonsOf[i])), 0).xyz;
    vec2 areas = 0.5 * vec2(twiceArea(corners[0], corners[1], corners[2]),
                            twiceArea(corners[0], corners[2], corners[3]));
    vec3 first = vec3(0.0);
    vec3 second = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        VertexShares shares = photonShares[photonsOf[i]];
        ivec2 texel = ivec2(photonTexel(photons, photonsOf[i]));
        vec3 flux = wholeFlux(originAt(texel), texelFetch(hitFlux, texel, 0).rgb) *
                    (shares.quarter * shares.cells);
        bool hasArea = shares.area > 0.0;
        vec2 part = hasArea ? areas / shares.area : vec2(1.0 / max(shares.triangles, 1.0));
        if (i != 3) first += flux * part.x;
        if (i != 1) second += flux * part.y;
        made.densities[i] = hasArea ? (flux.r + flux.g + flux.b) / shares.area : 0.0;
    }
    made.flux = first + second;
    float all = made.flux.r + made.flux.g + made.flux.b;
    made.first = all > 0.0 ? (first.r + first.g + first.b) / all : 0.5;
}

// Irradiance without how the surface turns away from light that comes in this direction, which the
// pixels know, W/m².
float densityOf(Arrival corner, vec3 direction) {
    return reconstruct_triangles_shading == reconstruct_triangles_shading_smooth
               ? corner.density / max(abs(dot(corner.normal, direction)), kMinLitSlant)
               : corner.density;
}

// Between four photons, from the one at the lower left.
Patch patchBetween(Arrival a, Arrival b, Arrival c, Arrival d) {
    Patch made;
    made.isJoined = true;
    made.isAlone = false;
    made.first = 0.5;
    made.narrowing = 1.0;
    made.corners = vec3[4](a.position, b.position, c.position, d.position);
    made.side = sideOf(normalize(a.normal + b.normal + c.normal + d.normal),
                       normalize(a.direction + b.direction + c.direction + d.direction), a.material);
    vec3 direction = made.side.direction;
    made.densities = float[4](densityOf(a, direction), densityOf(b, direction),
                              densityOf(c, direction), densityOf(d, direction));
    made.flux = a.flux + b.flux + c.flux + d.flux;
    // A surface that turns between the corners leaves the triangles.
    float turn = max(max(length(a.normal - c.normal), length(b.normal - d.normal)), 0.02);
    float wide = max(length(a.position - c.position), length(b.position - d.position));
    made.tolerance = 0.25 * turn * wide;
#ifdef LIGHT_SPREAD
    made.spread = mat2x3[4](a.spread, b.spread, c.spread, d.spread);
    made.cellArea = 0.5 * length(cross(c.position - a.position, d.position - b.position));
#endif
    return made;
}

uint neighbourOf(PhotonOrigin origin, ivec2 neighbourOffset) {
    return neighbourAt(origin, neighbourOffset) - 1u;
}

// With the flux of a quarter of its cell.
Arrival cornerOf(uint index) {
    Arrival corner = arrivalOf(ivec2(photonTexel(photons, index)));
    corner.flux *= photonShares[index].quarter;
    return corner;
}

// What a photon's flux has of a quarter of its cell.
float fluxShare(Arrival at, uint index, uint quarter) {
    return photonShares[index].quarter * areaOf(cornersOf(at, quarter));
}

Patch patchOfQuarter(Arrival own, QuarterCorners corners, float farthest) {
    vec2 ends[4] = vec2[4](vec2(0.0), corners.along, corners.across, corners.up);
    return patchOfBeam(own, ends, farthest);
}

// What the quarters between four photons have is shared out anew, by what each covers now.
Patch patchAtCrease(PhotonOrigin origin, uint quarter) {
    uint found[4];
    photonsAround(origin, quarter ^ 3u, found);
    ArrivalsAround around = arrivalsOf(found);
    vec3 flux = vec3(0.0);
    float weights = 0.0;
    float ownWeight = 0.0;
    QuarterCorners ownCorners;
    for (uint i = 0u; i < 4u; ++i) {
        Arrival corner = around.corners[i];
        // Seen from the corner, the others lie the other way.
        flux += corner.flux * fluxShare(corner, found[i] - 1u, i ^ 3u);
        QuarterCorners corners =
            cornersOf(corner, quarterAtCrease(around, i), sideOfQuarter(i ^ 3u));
        float weight = sumOfChannels(corner.flux) * areaOf(corners);
        weights += weight;
        if (i != (quarter ^ 3u)) continue;
        ownWeight = weight;
        ownCorners = corners;
    }
    Arrival own = around.corners[quarter ^ 3u];
    own.flux = weights > 0.0 ? flux * (ownWeight / weights)
                             : own.flux * fluxShare(own, found[quarter ^ 3u] - 1u, quarter);
    return patchOfQuarter(own, ownCorners, 1.0);
}

// Between the photons at the corners of so many cells.
Patch patchOfCells(uint index, int side) {
    PhotonOrigin origin = originAt(ivec2(photonTexel(photons, index)));
    uint around[4] = uint[4](index, neighbourOf(origin, ivec2(side, 0)),
                             neighbourOf(origin, ivec2(side)), neighbourOf(origin, ivec2(0, side)));
    Patch made = patchBetween(cornerOf(around[0]), cornerOf(around[1]), cornerOf(around[2]),
                              cornerOf(around[3]));
    if (reconstruct_triangles_shading == reconstruct_triangles_shading_vertices)
        shareByAreas(made, around);
    return made;
}

#ifdef MERGES
layout(std430) buffer PatchBlocks {
    PatchBlock blocks[];
};

// Its power is the sum of all that it is made of (U08, section 5).
Patch patchOfBlock(uint index, uint merges) {
    Patch made = patchOfCells(index, 1 << merges);
    made.flux = blocks[index].flux.rgb;
    float first = twiceArea(made.corners[0], made.corners[1], made.corners[2]);
    float second = twiceArea(made.corners[0], made.corners[2], made.corners[3]);
    made.first = first + second > 0.0 ? first / (first + second) : 0.5;
    return made;
}
#endif

#if defined(JOINED_PATCHES)
Patch wholePatchOf(uint index, uint part) {
#ifdef MERGES
    if (part >= kPatchMerged) return patchOfBlock(index, part - kPatchMerged + 1u);
#endif
    return patchOfCells(index, 1);
}
#elif defined(CREASE_PATCHES)
Patch wholePatchOf(uint index, uint part) {
    return patchAtCrease(originAt(ivec2(photonTexel(photons, index))), part - kPatchCrease);
}
#else
vec2[4] endsOfHalf(uint side) {
    vec2 low = vec2(side == 3u ? 0.0 : -0.5, side == 1u ? 0.0 : -0.5);
    vec2 high = vec2(side == 2u ? 0.0 : 0.5, side == 0u ? 0.0 : 0.5);
    return vec2[4](low, vec2(high.x, low.y), high, vec2(low.x, high.y));
}

Patch wholePatchOf(uint index, uint part) {
    Arrival own = arrivalOf(ivec2(photonTexel(photons, index)));
    vec2 ends[4];
    // Photons at a border reach beyond their cells.
    float farthest = own.extent == uvec2(0u) ? 0.5 : 1.0;
    if (part == kPatchBeam) {
        ends = vec2[4](vec2(-0.5), vec2(0.5, -0.5), vec2(0.5), vec2(-0.5, 0.5));
        for (int i = 0; i < 4; ++i) ends[i] *= reachTowards(own, ends[i]);
    } else if (part >= kPatchHalf) {
        uint quarters = quartersOfHalf(part - kPatchHalf);
        own.flux *= fluxShare(own, index, uint(findLSB(quarters))) +
                    fluxShare(own, index, uint(findMSB(quarters)));
        ends = endsOfHalf(part - kPatchHalf);
    } else {
        own.flux *= fluxShare(own, index, part);
        QuarterCorners corners = cornersOf(own, part);
        ends = vec2[4](vec2(0.0), corners.along, corners.across, corners.up);
    }
    Patch made = patchOfBeam(own, ends, farthest);
    made.isAlone = photonShares[index].cells == 0.0 && own.extent == uvec2(0u);
    return made;
}
#endif

// With the share of its flux that this map takes.
Patch patchOf(uint item) {
    uint index = item / kPatchParts;
    Patch made = wholePatchOf(index, item % kPatchParts);
    made.flux *= arrivedShare(ivec2(photonTexel(photons, index)));
    return made;
}
