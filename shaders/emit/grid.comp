// SPDX-License-Identifier: MIT
// One photon a cell of the light's grid, where the first surface that the light sees through the
// cell's middle is specular: its flux is what the light sends through what it stands for
// (include/photons/cell_extent.glsl), by its area (directional) or its solid angle (cos³; hard case 34a). An
// opaque surface nearer to the light leaves the cell empty. One thread a cell.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/neighbour_batch.glsl"
#include "include/photons/cell_extent.glsl"
#include "include/photons/light_grid.glsl"
#include "include/surfaces/specular.glsl"
#include "include/photons/store_photons.glsl"
// OpenGL grants a shader no more than eight images.
#define HITS_WITHOUT_SHAPE
#include "include/photons/store_hits.glsl"

#ifdef CELL_EXTENTS
layout(rg32ui) writeonly uniform uimage2D nextExtents;
#endif

uniform ivec2 ownRows;  // of the grid, from and before

#ifdef LEAVES_OUT_REFINED
layout(std430) readonly buffer RefinedFlags {
    uint refinedFlags[];  // by square between four photons (Samples::refined)
};
uniform ivec2 batchRows;   // of the grid: the first, and how many
uniform int lightOfBatch;  // counted from its first
#endif

// Whether the photon does not stand for what lies between it and the neighbours in a quarter.
bool isLeftOut(ivec2 cell, uint quarter) {
#if defined(REFINED_SQUARES)
    // Each square has photons of its own at its border.
    return isBeyondSquare(placeInSquare(threadOfList()), quarter);
#elif defined(LEAVES_OUT_REFINED)
    ivec2 square = cell - ivec2(0, batchRows.x) + ivec2(quarter & 1u, quarter >> 1u);
    int row = lightOfBatch * (batchRows.y + 1) + square.y;
    return refinedFlags[row * (gridSize.x + 1) + square.x] != 0u;
#else
    return false;
#endif
}

// Sub-cells in a row from `start` on in which the light sees the object, no more than `maximum`.
int countFrom(ivec2 cell, ivec2 start, ivec2 step, uint object, int maximum) {
    int count = 0;
    while (count < maximum && objectThrough(cell, start + count * step) == object) ++count;
    return count;
}

// How far from a sub-cell the light sees the object, in cells. Rows beside, by pairs, tell where a
// slanted border runs better than a sub-cell's width.
float reachFrom(ivec2 cell, ivec2 start, ivec2 step, uint object) {
    int sum = max(countFrom(cell, start, step, object, subcells), 1);
    int rows = 1;
    ivec2 neighbourOffset = ivec2(-step.y, step.x);
    int maximum = subcells + subcells / 2;
    for (int i = 1; i <= subcells / 2; ++i) {
        int left = countFrom(cell, start + i * neighbourOffset, step, object, maximum);
        int right = countFrom(cell, start - i * neighbourOffset, step, object, maximum);
        if (min(left, right) == 0 || max(left, right) == maximum) break;
        sum += left + right;
        rows += 2;
    }
    return min(float(sum) / float(rows) - 0.5, float(subcells)) / float(subcells);
}

// The quarter's part towards its far corner (along, up), as far as the light sees the object.
vec2 reachAcross(ivec2 cell, ivec2 side, vec2 corner, uint object) {
    int steps = 2 * subcells;
    float share = 0.5 / float(steps);
    for (int i = 1; i <= steps; ++i) {
        float at = (float(i) - 0.5) / float(steps);
        ivec2 neighbourOffset = side * ivec2(floor(at * corner * float(subcells) + 0.5));
        if (objectThrough(cell, neighbourOffset) != object) break;
        share = float(i) / float(steps);
    }
    return share * corner;
}

CellQuarter quarterAround(ivec2 cell, ivec2 side, uint object) {
    bool isNeighbour = seenThrough(cell + ivec2(side.x, 0)).x == object;
    bool isAbove = seenThrough(cell + ivec2(0, side.y)).x == object;
    bool isAcross = seenThrough(cell + side).x == object;
    if (isNeighbour && isAbove && isAcross) return kWholeQuarter;
    ivec2 middle = side * (subcells / 2);
    CellQuarter quarter = kWholeQuarter;
    if (!isNeighbour) quarter.along = reachFrom(cell, ivec2(0), side * ivec2(1, 0), object);
    if (!isAbove) quarter.up = reachFrom(cell, ivec2(0), side * ivec2(0, 1), object);
    // Of three cells that meet where the fourth is dark, each goes up to where the one across sees the
    // border on the diagonal.
    if (isNeighbour && isAbove) {
        quarter.across = vec2(reachFrom(cell, ivec2(0), side, object));
    } else if (isNeighbour && isAcross) {
        float there =
            reachFrom(cell, side * ivec2(subcells, 0), side * ivec2(-1, 1), object);
        quarter.across = vec2(1.0 - there, there);
    } else if (isAbove && isAcross) {
        float there =
            reachFrom(cell, side * ivec2(0, subcells), side * ivec2(1, -1), object);
        quarter.across = vec2(there, 1.0 - there);
    } else if (isNeighbour) {
        quarter.across.y = reachFrom(cell, ivec2(middle.x, 0), side * ivec2(0, 1), object);
    } else if (isAbove) {
        quarter.across.x = reachFrom(cell, ivec2(0, middle.y), side * ivec2(1, 0), object);
    } else {
        vec2 corner = vec2(quarter.along, quarter.up);
        quarter.across =
            reachAcross(cell, side, isAcross ? min(corner, vec2(0.5)) : corner, object);
    }
    return quarter;
}

// Whether the light sees the object through the middles of all cells around.
bool isAmongCells(ivec2 cell, uint object) {
    bool isAmong = true;
    for (int i = 0; i < 9; ++i) {
        ivec2 side = ivec2(i % 3, i / 3) - 1;
        isAmong = isAmong && seenThrough(cell + side).x == object;
    }
    return isAmong;
}

uvec2 extentOf(ivec2 cell, uint object) {
    bool isKnown = isAmongCells(cell, object);
    for (uint i = 0u; i < 4u; ++i) isKnown = isKnown && !isLeftOut(cell, i);
    CellQuarter quarters[4];
    bool isWhole = true;
    uint quarter = 0u;
    // A software rasteriser can't leave out a branch, but leaves a loop as soon as all threads may.
    do {
        if (isKnown) break;
        if (isLeftOut(cell, quarter)) {
            quarters[quarter] = kNoQuarter;
        } else {
            quarters[quarter] = quarterAround(cell, ivec2(sideOfQuarter(quarter)), object);
        }
        isWhole = isWhole && quarters[quarter] == kWholeQuarter;
    } while (++quarter < 4u);
    return isWhole ? uvec2(0u) : packedExtent(quarters);
}

// The photon that starts at a cell, where it has hit its first surface.
struct Emitted {
    Photon photon;
    vec3 normal;
    uint material;  // index + 1
    uvec2 extent;
};

void store(ivec2 cell, ivec2 texel, Emitted emitted) {
#ifdef REFINED_SQUARES
    PlaceInSquare place = placeInSquare(threadOfList());
    uint number = numberInList(place);
    ivec2 extentTexel = extentTexelOf(place);
#else
    uint number = uint(cell.y) * uint(gridSize.x) + uint(cell.x);
    ivec2 extentTexel = texel;
#endif
    PhotonOrigin origin = PhotonOrigin(number, uint(lightIndex), kEmittedPath, 0u, 0u);
    Photon photon = emitted.photon;
    storeNext(uint(texel.y) * nextPhotons.rowLength + uint(texel.x), photon, origin);
    storeHit(texel, Hit(photon.positionVs, 0.0, emitted.normal, emitted.material, photon.fluxWatts,
                        photon.fate, vec3(0.0)));
#ifdef CELL_EXTENTS
    imageStore(nextExtents, extentTexel, uvec4(emitted.extent, 0u, 0u));
#endif
}

const Emitted kNotEmitted =
    Emitted(Photon(vec3(0.0), 0.0, vec3(0.0), kFateNone, vec3(0.0), 0u), vec3(0.0), 0u, uvec2(0u));

Emitted emittedFrom(ivec2 cell) {
    uvec2 seen = seenThrough(cell);
    uint material = seen.x == 0u ? 0u : instances[seen.x - 1u].material.x;
    if (seen.x == 0u || isReceiver(materialKind(material))) return kNotEmitted;
    takeBandOf(uint(lightIndex));
    LightData light = lights[lightIndex];
    bool isParallel = uint(light.positionVs.w) == kLightDirectional;
    vec2 place = placeOfCell(cell);
    PointOnTriangle point = pointOnTriangle(seen, place, isParallel);
    vec3 direction = lightDirection(light, point.position);
    vec3 geometric = point.geometric == vec3(0.0) ? -direction : point.geometric;
    // A light whose rays first hit a dielectric from within is inside of it.
    bool isInside =
        materialKind(material) == kMaterialDielectric && dot(direction, geometric) > 0.0;
    uint media = isInside ? enterMedium(0u, material + 1u) : 0u;
    vec2 size = sizeOfCell();
    vec3 flux;
    float footprint;
    if (isParallel) {
        flux = light.power.rgb * (size.x * size.y);
        footprint = sqrt(size.x * size.y);
    } else {
        float cosine = inversesqrt(1.0 + dot(place, place));
        float solidAngle = size.x * size.y * cosine * cosine * cosine;
        float distance = length(point.position - light.positionVs.xyz);
        flux = lightIntensity(light, point.position, max(size.x, size.y)) * solidAngle *
               mediumTransmittance(innerMedium(media), distance);
        footprint = sqrt(solidAngle) * distance;
    }
    flux = fluxOfBand(flux);
    if (!(flux.r + flux.g + flux.b > 0.0)) return kNotEmitted;
    uvec2 extent = uvec2(0u);
#ifdef CELL_EXTENTS
    extent = extentOf(cell, seen.x);
    bool isNothing = true;
    for (uint i = 0u; i < 4u; ++i) isNothing = isNothing && isLeftOut(cell, i);
    if (isNothing) return kNotEmitted;
#endif
    flux *= areaOfExtent(extent);
    if (cell.y < ownRows.x || cell.y >= ownRows.y) flux *= kNegligible;
    vec3 shading = shadingNormal(point.normal, geometric);
    vec3 normal = bendingNormal(direction, shading, geometric, material + 1u, media);
    if (normal != shading) ledgerAdd(kAccountTriangleNormal, flux);
    Photon photon = Photon(point.position, footprint, direction, kFateSpecular, flux, media);
    return Emitted(photon, normal, material + 1u, extent);
}

void threadMain() {
    ivec2 cell;
    ivec2 texel;
    if (cellOfThread(cell, texel)) store(cell, texel, emittedFrom(cell));
}
