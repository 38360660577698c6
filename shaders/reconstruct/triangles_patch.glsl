// SPDX-License-Identifier: MIT
// What a patch of a receiver, four corners that light arrives between, covers of each pixel: two
// triangles with half of the flux each, evenly spread over each as it lies in space, or by the
// densities at their corners. Whatever their shape, size and slant, what all pixels have of them
// adds up to one, but for how what they see is turned.
#include "include/maps/coverage.glsl"
#include "include/photons/beam.glsl"
#include "include/photons/ledger.glsl"
#include "include/views/seen_receiver.glsl"

// How the surface lies, and from where light comes to it.
struct PatchSide {
    vec3 normal;
    vec3 direction;
    bool isFromBehind;  // to the back of a sheet
};

struct Patch {
    vec3 corners[4];  // around it
    float densities[4];
    float first;      // share of the flux in the first of its two triangles
    PatchSide side;
    vec3 flux;
    float tolerance;  // of the depths that pixels see, m, next to their own footprint
    float narrowing;  // by which factor a beam is narrower than it was to be; 1: it is not
    bool isJoined;    // between photons; false: a beam's
#ifdef LIGHT_SPREAD
    mat2x3 spread[4];  // of the corners, to where the edge of a light's disc has them, m
    float cellArea;    // that a whole cell covers about there, m²
#endif
};

// One of a patch's two triangles on the screen.
struct PatchTriangle {
    Triangle onScreen;
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
    Triangle at = made.onScreen;
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
    bool isFlat = size > 1e-3 * dot(edges, edges);
    made.plane = isFlat ? area / size : whole.side.normal;
    // One that hardly faces as the surface does is a fold of the light's.
    if (abs(dot(made.plane, whole.side.normal)) < 0.5) made.plane = whole.side.normal;
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
    Triangle first;  // with its x and y exchanged where they are columns
    Triangle second;
    ivec2 base;
    ivec2 low;   // x: of a line's pixels; y: of the lines
    ivec2 high;
};

Triangle exchanged(Triangle of) {
    vec3 slopes = vec3(slopeOf((of.b - of.a).yx), slopeOf((of.c - of.b).yx),
                       slopeOf((of.a - of.c).yx));
    return Triangle(of.a.yx, of.b.yx, of.c.yx, slopes, -of.area);
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
    addToSpan(span, lines.first, heights);
    addToSpan(span, lines.second, heights);
    if (span.x > span.y) return ivec2(1, 0);
    ivec2 pixels = ivec2(floor(span)) + lines.base.x;
    return ivec2(max(pixels.x, lines.low.x), min(pixels.y, lines.high.x));
}

ivec2 pixelOnLine(PatchLines lines, int line, int place) {
    return lines.areColumns ? ivec2(line, place) : ivec2(place, line);
}

struct PatchPixel {
    float share;
    float inView;  // the same without how its surface is turned
    int where;
};

// A beam that grazes a plane by less than this sine tells nothing of how light falls on what turns
// away from it.
const float kMinLitSlant = 0.05;

// What the pixel sees where a plane of the patch's surface would be: kSeen…; `area`, m²: of the plane,
// through which the light comes that falls on what is seen, or, where it is not seen, that is before
// the pixel. `lit`: how much of the light through that area falls on what is seen: what turns away from
// it has less by its cosine, unless that is known already, and what is turned off it none.
int seenOnPlane(ivec2 pixel, vec3 plane, vec3 point, bool isShaded, PatchSide side, float tolerance,
                out float area, out float lit) {
    vec3 ray = viewRay(vec2(pixel) + 0.5);
    float facing = boundedSlant(dot(plane, ray), 1e-4);
    float depth = max(depthOnPlane(pixel, plane, point, facing), view.frustum.z);
    // A surface that lies less slanted than the plane is another one, next to it or in front.
    vec3 seenNormal = receiverSurfaceAt(pixel).xyz;
    float margin = min(depthMargin(ray, depth, plane),
                       depthMargin(ray, abs(receiverAt(pixel).x), seenNormal));
    int seen = seenAt(pixel, depth, side.normal, tolerance + margin, area);
    lit = 1.0;
    if (seen != kSeenOn) {
        area = pixelArea(ray, depth, plane);
    } else {
        float cosine = dot(seenNormal, side.direction) * (side.isFromBehind ? 1.0 : -1.0);
        float slant = abs(dot(plane, side.direction));
        float least = max(kMinLitSlant - slant, 0.0);
        if (!isShaded) lit = (cosine + least) / (slant + least);
        if (cosine <= 0.0) lit = 0.0;
    }
    return seen;
}

float partOf(PatchTriangle triangle, vec2 corner) {
    vec3 weights = triangle.weights * vec3(corner + 0.5, 1.0);
    if (any(lessThanEqual(weights, -triangle.changes))) return 0.0;
    float covered = 1.0;
    if (any(lessThan(weights, triangle.changes))) {
        covered = coverageOf(triangle.onScreen, corner);
        if (covered <= 0.0) return 0.0;
        // The density where the triangle is nearest to the pixel's middle.
        weights = max(weights, 0.0);
        weights /= weights.x + weights.y + weights.z;
    }
    return covered * triangle.perArea * dot(weights, triangle.densities);
}

PatchPixel patchAt(PatchOnScreen onto, ivec2 pixel) {
    vec2 corner = vec2(pixel - onto.base);
    float first = partOf(onto.first, corner);
    float second = partOf(onto.second, corner);
    float covered = first + second;
    if (covered <= 0.0) return PatchPixel(0.0, 0.0, kSeenOutside);
    bool isFirst = first >= second;
    float area;
    float lit;
    int where = seenOnPlane(pixel, isFirst ? onto.first.plane : onto.second.plane,
                            isFirst ? onto.first.middle : onto.second.middle,
                            isFirst ? onto.first.isShaded : onto.second.isShaded, onto.side,
                            onto.tolerance, area, lit);
    return PatchPixel(covered * area * lit, covered * area, where);
}

struct PatchParts {
    float on;
    float occluded;
    float inView;  // seen or not: all of it but for rounding where none is next to the view
};

void addPart(inout PatchParts parts, PatchPixel pixel) {
    if (pixel.where == kSeenOn) parts.on += pixel.share;
    if (pixel.where == kSeenOccluded) parts.occluded += pixel.share;
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

// What every `step`th line from the first one on covers.
void addParts(PatchOnScreen onto, int first, int step, inout PatchParts parts) {
    PatchLines lines = linesOf(onto);
    for (int line = lines.low.y + first; line <= lines.high.y; line += step) {
        ivec2 span = spanOf(lines, line);
        for (int place = span.x; place <= span.y; ++place)
            addPart(parts, patchAt(onto, pixelOnLine(lines, line, place)));
    }
}
