// SPDX-License-Identifier: MIT
// What a patch of a receiver, four corners that light arrives between, covers of each pixel: two
// triangles with half of the flux each, evenly spread over each as it lies in space, or by the
// densities at their corners. Whatever their shape, size and slant, the shares of all pixels add up
// to one.
#include "include/maps/coverage.glsl"
#include "include/photons/arriving.glsl"
#include "include/photons/ledger.glsl"
#include "include/surfaces/surface_data.glsl"
#include "reconstruct/triangles_crease.glsl"
#include "reconstruct/triangles_patch_list.glsl"
#include "include/views/seen_receiver.glsl"


struct Patch {
    vec3 corners[4];  // around it
    float densities[4];
    float first;      // share of the flux in the first of its two triangles
    vec3 normal;
    vec3 direction;
    vec3 flux;
    float tolerance;  // of the depths that pixels see, m, next to their own footprint
    float narrowing;  // by which factor a beam is narrower than it was to be; 1: it is not
};

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
    made.narrowing = 1.0;
    if (widest * scale > largest) {
        scale = largest / widest;
        made.narrowing = widest / largest;
    }
    mat2x3 spacing = at.spacing * scale;
    for (int i = 0; i < 4; ++i) made.corners[i] = at.position + spacing * ends[i];
    made.densities = float[4](1.0, 1.0, 1.0, 1.0);
    made.first = 0.5;
    made.normal = at.normal;
    made.direction = at.direction;
    made.flux = at.flux;
    made.tolerance = 0.25 * scale * length(extent);
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

// Between four photons, from the one at the lower left.
Patch patchBetween(Arrival a, Arrival b, Arrival c, Arrival d) {
    Patch made;
    made.first = 0.5;
    made.narrowing = 1.0;
    made.corners = vec3[4](a.position, b.position, c.position, d.position);
    made.densities = float[4](a.density, b.density, c.density, d.density);
    made.normal = normalize(a.normal + b.normal + c.normal + d.normal);
    made.direction = normalize(a.direction + b.direction + c.direction + d.direction);
    made.flux = a.flux + b.flux + c.flux + d.flux;
    // A surface that turns between the corners leaves the triangles.
    float turn = max(max(length(a.normal - c.normal), length(b.normal - d.normal)), 0.02);
    float wide = max(length(a.position - c.position), length(b.position - d.position));
    made.tolerance = 0.25 * turn * wide;
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

Patch wholePatchOf(uint item) {
    uint index = item / kPatchParts;
    uint part = item % kPatchParts;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (part == kPatchJoined) return patchOfCells(index, 1);
#ifdef MERGES
    if (part >= kPatchMerged) return patchOfBlock(index, part - kPatchMerged + 1u);
#endif
    if (part >= kPatchCrease) return patchAtCrease(originAt(texel), part - kPatchCrease);
    Arrival own = arrivalOf(texel);
    if (part == kPatchBeam) {
        vec2 ends[4] = vec2[4](vec2(-0.5), vec2(0.5, -0.5), vec2(0.5), vec2(-0.5, 0.5));
        for (int i = 0; i < 4; ++i) ends[i] *= reachTowards(own, ends[i]);
        return patchOfBeam(own, ends, 0.5);
    }
    own.flux *= fluxShare(own, index, part);
    // Photons at a border reach beyond their cells.
    return patchOfQuarter(own, cornersOf(own, part), own.extent == uvec2(0u) ? 0.5 : 1.0);
}

// With the share of its flux that this map takes.
Patch patchOf(uint item) {
    Patch made = wholePatchOf(item);
    made.flux *= arrivedShare(ivec2(photonTexel(photons, item / kPatchParts)));
    return made;
}

// One of a patch's two triangles on the screen.
struct PatchTriangle {
    Triangle onScreen;
    vec3 plane;      // unit normal, of the view
    vec3 middle;
    float perArea;   // share of the patch's flux over the triangle's area, 1/m²
    vec3 densities;  // at its corners, about 1
};

PatchTriangle patchTriangle(Patch whole, vec3 a, vec3 b, vec3 c, vec3 densities, float part,
                            vec2 base) {
    PatchTriangle made;
    made.onScreen = triangleOf(pixelOf(a) - base, pixelOf(b) - base, pixelOf(c) - base);
    vec3 area = cross(b - a, c - a);
    float size = length(area);
    // A triangle that is nearly a line has no plane of its own.
    vec3 edges = abs(b - a) + abs(c - a);
    bool isFlat = size > 1e-3 * dot(edges, edges);
    made.plane = isFlat ? area / size : whole.normal;
    // One that hardly faces as the surface does is a fold of the light's.
    if (abs(dot(made.plane, whole.normal)) < 0.5) made.plane = whole.normal;
    vec3 middle = (a + b + c) / 3.0;
    made.middle = middle;
    float covered = abs(made.onScreen.area) *
                    pixelArea(viewRay(pixelOf(middle)), -middle.z, made.plane);
    made.perArea = part / max(isFlat ? max(0.5 * size, 0.25 * covered) : covered, 1e-30);
    // Where the densities differ too much, they are those of a fold and say nothing of its middle.
    float mean = (densities.x + densities.y + densities.z) / 3.0;
    float minimum = min(densities.x, min(densities.y, densities.z));
    float maximum = max(densities.x, max(densities.y, densities.z));
    bool isSmooth = reconstruct_triangles_shading == reconstruct_triangles_shading_smooth
                        ? maximum <= 4.0 * minimum
                        : reconstruct_triangles_shading == reconstruct_triangles_shading_vertices;
    made.densities = isSmooth && mean > 0.0 ? densities / mean : vec3(1.0);
    return made;
}

struct PatchOnScreen {
    PatchTriangle first;
    PatchTriangle second;
    ivec2 base;  // pixel that the triangles' corners count from
    ivec2 low;   // the rectangle of pixels that may be covered, within the view
    ivec2 high;
    bool isWhole;  // none of it is next to the view
    float tolerance;
    vec3 normal;
};

PatchOnScreen onScreen(Patch whole) {
    vec2 a = pixelOf(whole.corners[0]);
    vec2 b = pixelOf(whole.corners[1]);
    vec2 c = pixelOf(whole.corners[2]);
    vec2 d = pixelOf(whole.corners[3]);
    vec2 minimum = min(min(a, b), min(c, d)) - 2.0 * kMinHeight;
    vec2 maximum = max(max(a, b), max(c, d)) + 2.0 * kMinHeight;
    PatchOnScreen made;
    made.base = ivec2(floor(minimum));
    ivec2 end = ivec2(floor(maximum));
    made.low = max(made.base, ivec2(0));
    made.high = min(end, ivec2(view.sizePixels.xy) - 1);
    made.isWhole = made.low == made.base && made.high == end;
    vec2 base = vec2(made.base);
    float q[4] = whole.densities;
    made.first = patchTriangle(whole, whole.corners[0], whole.corners[1], whole.corners[2],
                               vec3(q[0], q[1], q[2]), whole.first, base);
    made.second = patchTriangle(whole, whole.corners[0], whole.corners[2], whole.corners[3],
                                vec3(q[0], q[2], q[3]), 1.0 - whole.first, base);
    made.tolerance = whole.tolerance;
    made.normal = whole.normal;
    return made;
}

// The least and the largest column that a row's pixels can be covered in; empty where x > y.
ivec2 columnsOf(PatchOnScreen onto, int row) {
    vec2 heights = vec2(row - onto.base.y) + vec2(0.0, 1.0);
    vec2 span = vec2(1e9, -1e9);
    addToSpan(span, onto.first.onScreen, heights);
    addToSpan(span, onto.second.onScreen, heights);
    if (span.x > span.y) return ivec2(1, 0);
    ivec2 columns = ivec2(floor(span)) + onto.base.x;
    return ivec2(max(columns.x, onto.low.x), min(columns.y, onto.high.x));
}

struct PatchPixel {
    float share;
    int where;
};

// What the pixel sees where a plane of the patch's surface would be: kSeen…; `area`, m², of the
// surface or, where it is not seen, of the plane.
int seenOnPlane(ivec2 pixel, vec3 plane, vec3 point, vec3 normal, float tolerance,
                out float area) {
    vec3 ray = viewRay(vec2(pixel) + 0.5);
    float facing = boundedSlant(dot(plane, ray), 1e-4);
    float depth = max(depthOnPlane(pixel, plane, point, facing), view.frustum.z);
    area = pixelArea(ray, depth, plane);
    return seenAt(pixel, depth, normal, tolerance + depthMargin(ray, depth, plane), area);
}

float partOf(PatchTriangle triangle, vec2 corner) {
    float covered = coverageOf(triangle.onScreen, corner);
    if (covered <= 0.0) return 0.0;
    // The density at the pixel's middle, or where the triangle is nearest to it.
    Triangle at = triangle.onScreen;
    vec2 p = corner + 0.5;
    vec3 weights = vec3((at.c.x - at.b.x) * (p.y - at.b.y) - (at.c.y - at.b.y) * (p.x - at.b.x),
                        (at.a.x - at.c.x) * (p.y - at.c.y) - (at.a.y - at.c.y) * (p.x - at.c.x),
                        (at.b.x - at.a.x) * (p.y - at.a.y) - (at.b.y - at.a.y) * (p.x - at.a.x));
    weights = max(weights / (2.0 * at.area), 0.0);
    float density = dot(weights, triangle.densities) / (weights.x + weights.y + weights.z);
    return covered * triangle.perArea * density;
}

PatchPixel patchAt(PatchOnScreen onto, ivec2 pixel) {
    vec2 corner = vec2(pixel - onto.base);
    float first = partOf(onto.first, corner);
    float second = partOf(onto.second, corner);
    float covered = first + second;
    if (covered <= 0.0) return PatchPixel(0.0, kSeenOutside);
    bool isFirst = first >= second;
    float area;
    int where = seenOnPlane(pixel, isFirst ? onto.first.plane : onto.second.plane,
                            isFirst ? onto.first.middle : onto.second.middle, onto.normal,
                            onto.tolerance, area);
    return PatchPixel(covered * area, where);
}

struct PatchParts {
    float on;
    float occluded;
    float outside;  // but within the view
};

void addPart(inout PatchParts parts, PatchPixel pixel) {
    if (pixel.where == kSeenOn) parts.on += pixel.share;
    if (pixel.where == kSeenOccluded) parts.occluded += pixel.share;
    if (pixel.where == kSeenOutside) parts.outside += pixel.share;
}

bool isBeforeView(Patch whole) {
    for (int i = 0; i < 4; ++i) {
        if (!(-whole.corners[i].z > view.frustum.z)) return false;
    }
    return true;
}

// The patch as a face sees it, which becomes the view; false: no part of it. The eye's or a light's
// one view sees all that is before it.
bool seenInFace(Patch whole, int face, out Patch there, out PatchOnScreen onto) {
    there = whole;
#ifdef MANY_VIEWS
    mat3 turn = mat3(views[face].fromEye) * transpose(mat3(views[0].fromEye));
    for (int i = 0; i < 4; ++i) there.corners[i] = turn * whole.corners[i];
    there.normal = turn * whole.normal;
    there.direction = turn * whole.direction;
    viewIndex = face;
    if (!isBeforeView(there)) return false;
#endif
    onto = onScreen(there);
#ifdef MANY_VIEWS
    return all(lessThanEqual(onto.low, onto.high));
#else
    return true;
#endif
}

void addParts(PatchOnScreen onto, inout PatchParts parts) {
    for (int row = onto.low.y; row <= onto.high.y; ++row) {
        ivec2 columns = columnsOf(onto, row);
        for (int column = columns.x; column <= columns.y; ++column)
            addPart(parts, patchAt(onto, ivec2(column, row)));
    }
}
