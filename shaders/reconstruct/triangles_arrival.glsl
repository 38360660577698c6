// SPDX-License-Identifier: MIT
// Where a photon arrives, and by its beam where its neighbours would.
#include "include/photons/neighbour_batch.glsl"
#include "include/photons/cell_extent.glsl"
#include "include/photons/cells.glsl"
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/views/view.glsl"

// A beam that grazes is taken as if it came at this sine at least, which bounds what it covers.
const float kMinArrivalSlant = 0.01;

#ifdef CELL_EXTENTS
uniform usampler2D cellExtents;
#endif

struct Arrival {
    vec3 position;  // of the view, m
    vec3 normal;    // unit, outward
    vec3 direction;
    mat2x3 spacing;  // to where the next cells' light arrives, along u and v, m
    vec2 farther;   // than this light flies, m
    float distance;
    vec3 flux;      // W, whole
    float density;  // the flux by what it stands for covers, W/m²
    uint material;  // index + 1
    uint path;
    uvec2 extent;   // include/photons/cell_extent.glsl
#ifdef LIGHT_SPREAD
    mat2x3 spread;  // to where light from the edge of its light's disc arrives, m
#endif
};

// What the photon stands for besides its cell; 0: its cell.
uvec2 extentOf(PhotonOrigin origin) {
#ifdef CELL_EXTENTS
    int row = (int(origin.light) - cellLights.x) * cellGrid.y;
    return texelFetch(cellExtents, cellOf(origin) + ivec2(0, row), 0).xy;
#else
    return uvec2(0u);
#endif
}

mat2x3 fromEye(mat2x3 offsets) {
    return mat2x3(directionFromEye(offsets[0]), directionFromEye(offsets[1]));
}

// What a photon carries in the batch that it is of.
vec3 wholeFlux(PhotonOrigin origin, vec3 flux) {
    return isFromOtherBatch(origin) ? flux * (1.0 / kNegligible) : flux;
}

float sumOfChannels(vec3 flux) { return flux.r + flux.g + flux.b; }

Arrival arrivalOf(ivec2 texel) {
    Hit hit = hitAt(texel);
    Photon photon = photonAt(texel);
    vec2 farther;
    mat2x3 spacing = beamOnPlane(beamAt(texel), photon.directionVs, hit.distanceMeters, hit.normalVs,
                                kMinArrivalSlant, farther);
    PhotonOrigin origin = originAt(texel);
    uvec2 extent = extentOf(origin);
    float area = length(cross(spacing[0], spacing[1])) * areaOfExtent(extent);
    vec3 flux = wholeFlux(origin, hit.fluxWatts);
#ifdef LIGHT_SPREAD
    mat2x3 spread = beamOnPlane(spreadOf(beamAt(texel)), photon.directionVs, hit.distanceMeters,
                                hit.normalVs, kMinArrivalSlant);
#endif
    return Arrival(pointFromEye(hit.positionVs), directionFromEye(hit.normalVs),
                   directionFromEye(photon.directionVs), fromEye(spacing), farther,
                   hit.distanceMeters, flux, sumOfChannels(flux) / max(area, 1e-30),
                   hit.material, origin.path, extent
#ifdef LIGHT_SPREAD
                   , fromEye(spread)
#endif
    );
}

// How far a beam goes on towards a corner of its cell, as shares of the way along u and v, before it
// would arrive where it has come from: light that enters water next to a wall lights none of the wall
// above it.
vec2 reachTowards(Arrival at, vec2 corner) {
    vec2 less = max(-at.farther * corner, 0.0);
    float all = less.x + less.y;
    if (all <= at.distance || at.distance <= 0.0) return vec2(1.0);
    bool isFirst = less.x > less.y;
    float more = max(less.x, less.y);
    float left = at.distance - min(less.x, less.y);
    if (left <= 0.0) return vec2(at.distance / all);
    return isFirst ? vec2(left / more, 1.0) : vec2(1.0, left / more);
}

// Where the corners of a quarter of what a photon stands for lie, in cells: on the axis u, between,
// and on the axis v, none farther than its light goes.
struct QuarterCorners {
    vec2 along;
    vec2 across;
    vec2 up;
};
QuarterCorners cornersOf(Arrival at, CellQuarter extent, vec2 side) {
    QuarterCorners corners = QuarterCorners(vec2(side.x * extent.along, 0.0), side * extent.across,
                                            vec2(0.0, side.y * extent.up));
    corners.along *= reachTowards(at, corners.along);
    corners.across *= reachTowards(at, corners.across);
    corners.up *= reachTowards(at, corners.up);
    return corners;
}

// Its area, as a share of a quarter of a cell.
float areaOf(QuarterCorners corners) {
    vec2 a = corners.along;
    vec2 b = corners.across;
    vec2 c = corners.up;
    return 2.0 * abs((a.x * b.y - a.y * b.x) + (b.x * c.y - b.y * c.x));
}

// Of one by the corner of the cell: right, up: bits.
QuarterCorners cornersOf(Arrival at, uint quarter) {
    return cornersOf(at, unpackedQuarter(at.extent, quarter), sideOfQuarter(quarter));
}

// Whether a photon stands for nothing of a quarter of its cell.
bool isLeftOut(Arrival at, uint quarter) {
    return areaOf(unpackedQuarter(at.extent, quarter)) <= 0.0;
}

// Whether two neighbours, `step` cells from one to the other, arrive on one surface where their
// beams, on the average, say of one another.
bool areNeighbours(Arrival a, Arrival b, vec2 step) {
    if (a.path != b.path || a.material != b.material) return false;
    if (dot(a.normal, b.normal) < 0.5) return false;
    vec3 spacingA = a.spacing * step;
    vec3 spacingB = b.spacing * step;
    vec3 between = b.position - a.position;
    vec3 off = between - 0.5 * (spacingA + spacingB);
    float maximum = max(length(between), max(length(spacingA), length(spacingB)));
    return length(off) <= reconstruct_triangles_tolerance * maximum;
}
