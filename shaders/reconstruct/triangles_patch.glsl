// SPDX-License-Identifier: MIT
// What a patch of a receiver, four corners that light arrives between, covers of each pixel: two
// triangles with half of the flux each, evenly spread over each as it lies in space, or by the
// densities at their corners. Whatever their shape, size and slant, what all pixels have of them
// adds up to one, but for how what they see is turned.
#include "framework/transport/coverage.h"
#include "framework/transport/patches.h"
#include "include/photons/beam.glsl"
#include "include/photons/ledger.glsl"
#include "include/views/edge_places.glsl"
#include "framework/transport/octahedral.h"
#include "include/views/seen_receiver.glsl"

struct Patch {
    vec3 corners[4];  // around it
    float densities[4];
    float first;      // share of the flux in the first of its two triangles
    PatchSide side;
    vec3 flux;
    float tolerance;  // of the depths that pixels see, m, next to their own footprint
    float narrowing;  // by which factor a beam is narrower than it was to be; 1: it is not
    bool isJoined;    // between photons; false: a beam's
    bool isAlone;     // of a beam: nothing next to it is joined, nor known to end
#ifdef LIGHT_SPREAD
    mat2x3 spread[4];  // of the corners, to where the edge of a light's disc has them, m
    float cellArea;    // that a whole cell covers about there, m²
#endif
};

// One of a patch's two triangles on the screen.
struct PatchTriangle {
    ScreenTriangle onScreen;
    // Barycentric coordinates of a place on the screen, of x, y, 1, and by how much they change from
    // the middle of a pixel to the farthest of its corners.
    mat3 weights;
    vec3 changes;
    vec3 plane;      // unit normal, of the view
    vec3 middle;
    float perArea;   // share of the patch's flux over the triangle's area, 1/m²
    vec3 densities;  // at its corners, about 1
    // These are of irradiance, and tell how the surface turns away from the light; false: of flux
    // through what lies across it.
    bool isShaded;
};

void setWeights(inout PatchTriangle made) {
    ScreenTriangle at = made.onScreen;
    vec3 x = vec3(at.b.y - at.c.y, at.c.y - at.a.y, at.a.y - at.b.y);
    vec3 y = vec3(at.c.x - at.b.x, at.a.x - at.c.x, at.b.x - at.a.x);
    vec3 begin = -x * vec3(at.b.x, at.c.x, at.a.x) - y * vec3(at.b.y, at.c.y, at.a.y);
    made.weights = mat3(x, y, begin) * (0.5 / at.area);
    made.changes = 0.5 * (abs(made.weights[0]) + abs(made.weights[1]));
}

PatchTriangle patchTriangle(Patch whole, vec3 a, vec3 b, vec3 c, vec3 densities, float part,
                            vec2 base) {
    PatchTriangle made;
    made.onScreen = triangleOf(pixelOf(a) - base, pixelOf(b) - base, pixelOf(c) - base);
    setWeights(made);
    vec3 area = cross(b - a, c - a);
    float size = length(area);
    // A triangle that is nearly a line has no plane of its own.
    vec3 edges = abs(b - a) + abs(c - a);
    bool isFlat = size > kMinFlatness * dot(edges, edges);
    made.plane = isFlat ? area / size : whole.side.normal;
    // One that hardly faces as the surface does is a fold of the light's.
    if (abs(dot(made.plane, whole.side.normal)) < kMinPlaneCosine) made.plane = whole.side.normal;
    vec3 middle = (a + b + c) / 3.0;
    made.middle = middle;
    float covered = abs(made.onScreen.area) *
                    pixelArea(viewRay(pixelOf(middle)), -middle.z, made.plane);
    made.perArea = part / max(isFlat ? max(0.5 * size, kMinOfCovered * covered) : covered, 1e-30);
    // Where the densities differ too much, they are those of a fold and say nothing of its middle.
    float mean = (densities.x + densities.y + densities.z) / 3.0;
    float minimum = min(densities.x, min(densities.y, densities.z));
    float maximum = max(densities.x, max(densities.y, densities.z));
    bool isSmooth = reconstruct_triangles_shading == reconstruct_triangles_shading_smooth
                        ? maximum <= kMaxDensityRatio * minimum
                        : reconstruct_triangles_shading == reconstruct_triangles_shading_vertices;
    isSmooth = isSmooth && mean > 0.0;
    made.densities = isSmooth ? densities / mean : vec3(1.0);
    made.isShaded = whole.isJoined &&
                    reconstruct_triangles_shading != reconstruct_triangles_shading_smooth;
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
    PatchSide side;
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
    made.side = whole.side;
    return made;
}

// The lines of pixels along the shorter side of the rectangle around a patch, so that those of
// different threads are about as long: rows, or columns.
struct PatchLines {
    bool areColumns;
    ScreenTriangle first;  // with its x and y exchanged where they are columns
    ScreenTriangle second;
    ivec2 base;
    ivec2 low;   // x: of a line's pixels; y: of the lines
    ivec2 high;
};

ScreenTriangle exchanged(ScreenTriangle of) {
    vec3 slopes = vec3(slopeOf((of.b - of.a).yx), slopeOf((of.c - of.b).yx),
                       slopeOf((of.a - of.c).yx));
    return ScreenTriangle(of.a.yx, of.b.yx, of.c.yx, slopes, -of.area);
}

PatchLines linesOf(PatchOnScreen onto) {
    ivec2 size = onto.high - onto.low;
    if (size.x <= size.y) {
        return PatchLines(false, onto.first.onScreen, onto.second.onScreen, onto.base, onto.low,
                          onto.high);
    }
    return PatchLines(true, exchanged(onto.first.onScreen), exchanged(onto.second.onScreen),
                      onto.base.yx, onto.low.yx, onto.high.yx);
}

// The first and the last of its pixels that can be covered; none where x > y.
ivec2 spanOf(PatchLines lines, int line) {
    vec2 heights = vec2(line - lines.base.y) + vec2(0.0, 1.0);
    vec2 span = vec2(1e9, -1e9);
    span = spanWith(spanWith(span, lines.first, heights), lines.second, heights);
    if (span.x > span.y) return ivec2(1, 0);
    ivec2 pixels = ivec2(floor(span)) + lines.base.x;
    return ivec2(max(pixels.x, lines.low.x), min(pixels.y, lines.high.x));
}

ivec2 pixelOnLine(PatchLines lines, int line, int place) {
    return lines.areColumns ? ivec2(line, place) : ivec2(place, line);
}

// What a pixel sees where a plane of a patch's surface would be, m² of the plane.
struct PlanePixel {
    float lit;       // through which the light comes that falls on what is seen
    float occluded;  // before which something nearer is seen
    float inView;    // that is before the pixel, seen or not
    float stored;    // `lit` for the area of the receiver that the pixel stands for
};

// By the receiver at a place in a pixel, `seen` and `seenNormal`, which stands for `share` of it.
// `isAway`: the patch lies next to that place, so that where another surface is seen there and
// nothing nearer, its own has ended in between, and all that lies in the pixel is seen.
// `storedArea`: of the receiver at its middle, m²; 0: the pixel stands for none, and what falls on
// this one is not seen.
void addSeen(inout PlanePixel pixel, vec2 place, vec2 seen, vec3 seenNormal, vec3 plane, vec3 point,
             bool isShaded, PatchSide side, float tolerance, bool isAway, float share,
             float storedArea) {
    vec3 ray = viewRay(place);
    float facing = boundedSlant(dot(plane, ray), 1e-4);
    float depth = max(depthOnPlane(place, plane, point, facing), view.frustum.z);
    // A surface that lies less slanted than the plane is another one, next to it or in front.
    float margin =
        min(depthMargin(ray, depth, plane), depthMargin(ray, abs(seen.x), seenNormal));
    float area;
    int where = seenOf(seen, seenNormal, depth, side.normal, tolerance + margin, area);
    if (where != kSeenOn) area = pixelArea(ray, depth, plane);
    if (where == kSeenOutside && isAway && seesLitSide(ray, side.normal, side.direction)) {
        where = kSeenOn;
        seenNormal = side.normal;
    }
    pixel.inView += share * area;
    if (where == kSeenOccluded) pixel.occluded += share * area;
    if (where == kSeenOn) {
        float lit = share * litShare(seenNormal, plane, isShaded, side);
        if (storedArea > 0.0) {
            pixel.lit += lit * area;
        } else {
            pixel.occluded += lit * area;
        }
        pixel.stored += lit * min(storedArea, kMaxStored * area);
    }
}

// The squares of a pixel that are looked at one by one, each by what is seen at one place in it: the
// whole, or, where a surface ends in the pixel, its quarters.
struct PixelParts {
    int count;
    float side;   // of each, px
    uint number;  // of the pixel among those at an edge, + 1
    vec2 middle;  // depth and area of the receiver at the pixel's middle
};

#ifdef EDGE_SAMPLES
uniform sampler2D edgeSamples;
#endif

PixelParts partsOf(ivec2 pixel) {
#ifdef EDGE_SAMPLES
    vec3 seen = texelFetch(edgeReceiver, pixel, 0).xyz;
    uint number = uint(seen.z);
    return PixelParts(number > 0u ? kEdgeSamples : 1, number > 0u ? 0.5 : 1.0, number, seen.xy);
#else
    return PixelParts(1, 1.0, 0u, receiverAt(pixel));
#endif
}

// From the pixel's corner, px.
vec2 cornerOfPart(PixelParts parts, int i) {
    return parts.side * vec2(i & 1, i >> 1);
}

// `place`: from the pixel's corner, px.
vec2 receiverOfPart(ivec2 pixel, PixelParts parts, int i, out vec2 place, out vec3 normal) {
    place = vec2(0.5);
#ifdef EDGE_SAMPLES
    if (parts.number > 0u) {
        place = edgePlace(i);
        vec4 seen = texelFetch(edgeSamples, edgeTexel(parts.number - 1u, i), 0);
        normal = unpackUnitVector(seen.zw);
        return seen.xy;
    }
#endif
    normal = receiverSurfaceAt(pixel).xyz;
    return parts.middle;
}

// Of a plane that covers all of the pixel.
PlanePixel seenOnPlane(ivec2 pixel, vec3 plane, vec3 point, bool isShaded, PatchSide side,
                       float tolerance) {
    PlanePixel made = PlanePixel(0.0, 0.0, 0.0, 0.0);
    PixelParts parts = partsOf(pixel);
    for (int i = 0; i < parts.count; ++i) {
        vec2 place;
        vec3 normal;
        vec2 seen = receiverOfPart(pixel, parts, i, place, normal);
        addSeen(made, vec2(pixel) + place, seen, normal, plane, point, isShaded, side, tolerance,
                false, parts.side * parts.side, parts.middle.y);
    }
    return made;
}

bool contains(PatchTriangle triangle, vec2 place) {
    return all(greaterThanEqual(triangle.weights * vec3(place, 1.0), vec3(0.0)));
}

// What a triangle has of a square in the view with this lower left corner, by the square's share that
// it covers, 1/m². `side`: of the square, px.
float partOf(PatchTriangle triangle, vec2 corner, float side) {
    vec3 weights = triangle.weights * vec3(corner + 0.5 * side, 1.0);
    vec3 changes = side * triangle.changes;
    if (any(lessThanEqual(weights, -changes))) return 0.0;
    float covered = 1.0;
    if (any(lessThan(weights, changes))) {
        covered = coverageOf(triangle.onScreen, corner, 1.0 / side);
        if (covered <= 0.0) return 0.0;
        // The density where the triangle is nearest to the square's middle.
        weights = max(weights, 0.0);
        weights /= weights.x + weights.y + weights.z;
    }
    return covered * triangle.perArea * dot(weights, triangle.densities);
}

bool isAwayFrom(PatchOnScreen onto, PixelParts parts, vec2 place) {
    return parts.number > 0u && !contains(onto.first, place) && !contains(onto.second, place);
}

struct PatchParts {
    float on;
    float occluded;
    float inView;  // seen or not: all of it but for rounding where none is next to the view
};

void addPart(inout PatchParts parts, PlanePixel pixel) {
    parts.on += pixel.lit;
    parts.occluded += pixel.occluded;
    parts.inView += pixel.inView;
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
    there.side.normal = turn * whole.side.normal;
    there.side.direction = turn * whole.side.direction;
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
