// SPDX-License-Identifier: MIT
// A patch as light with a size spreads it: the light of each place on the disc that a point of the
// light stands for lays the same patch somewhere else, to first order by how the corners' photons
// would move. Copies from places that are even over the disc make up the whole.
#include "reconstruct/triangles_patch.glsl"

// A disc whose radius is less than half of a pixel is not to be told from its middle, px.
const float kMinSpread = 0.5;

// Copies are a pixel apart, or a part of a large disc's radius: then light that ends at an edge
// fades in steps of a fiftieth.
const float kStepsOfRadius = 4.0;

struct Copies {
    int places;  // on the disc, as many as neighbours have; 1: none but its middle
    // Of a patch smaller than a pixel, those that are its own: every so many, from the first one on.
    int stride;
    int first;
};
const Copies kNoCopies = Copies(1, 1, 0);

vec3 middleOf(Patch whole) {
    return 0.25 * (whole.corners[0] + whole.corners[1] + whole.corners[2] + whole.corners[3]);
}

// `cell`: its photon's.
Copies copiesOf(Patch whole, ivec2 cell) {
    vec3 middle = middleOf(whole);
    mat2x3 spread = 0.25 * (whole.spread[0] + whole.spread[1] + whole.spread[2] + whole.spread[3]);
#ifdef MANY_VIEWS
    float pixel = pixelFootprint(length(middle));
    vec2 lengths = vec2(length(spread[0]), length(spread[1]));
    float spreadArea = length(cross(spread[0], spread[1]));
#else
    float pixel = pixelFootprint(max(-middle.z, view.frustum.z));
    vec2 lengths = vec2(length(spread[0].xy), length(spread[1].xy));
    float spreadArea = abs(spread[0].x * spread[1].y - spread[0].y * spread[1].x);
#endif
    lengths /= pixel;
    spreadArea /= pixel * pixel;
    // Of an ellipse the axes' squares add up to dot(lengths, lengths), and their product is
    // spreadArea.
    float sum = dot(lengths, lengths);
    float root = sqrt(max(sum * sum - 4.0 * spreadArea * spreadArea, 0.0));
    float longer = sqrt(0.5 * (sum + root));
    if (!(longer > kMinSpread) || isinf(longer)) return kNoCopies;
    float step = max(longer / kStepsOfRadius, 1.0);
    float wanted = max(2.0 * longer / step, 3.14159265 * spreadArea / (step * step));
    // Of few different numbers, so that neighbours mostly have the same and join as the patches do.
    int places = 1 << int(ceil(log2(clamp(wanted, 1.0, 64.0))));
    if (places == 1) return kNoCopies;
    places = max(places, 4);  // two would lie along one line
    // Patches that share pixels share the places out among 2, 4, … of them.
    float area = max(whole.cellArea / (pixel * pixel), 1.0 / 64.0);
    int stride = min(1 << int(max(-log2(area), 0.0)), places);
    int block = (cell.x & 1) + 2 * (cell.y & 1) + 2 * (cell.x & 2) + 4 * (cell.y & 2) +
                4 * (cell.x & 4) + 8 * (cell.y & 4);
    return Copies(places, stride, block % stride);
}

// A copy whose way from the patch goes through another surface that is seen there has landed on that
// one: a floor's light on the wall next to it.
Patch landed(Patch copy, vec3 from) {
#ifndef MANY_VIEWS
    vec3 to = middleOf(copy);
    if (!(-to.z > view.frustum.z)) return copy;
    ivec2 pixel = ivec2(floor(pixelOf(to)));
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(view.sizePixels.xy))))
        return copy;
    float depth = receiverAt(pixel).x;
    if (depth <= 0.0) return copy;
    vec3 seen = viewPoint(vec2(pixel) + 0.5, depth);
    vec3 normal = receiverSurfaceAt(pixel).xyz;
    float farthest = 4.0 * length(to - from);
    bool isThrough = dot(normal, from - seen) > 0.0 && dot(normal, to - seen) < 0.0;
    float slant = dot(normal, copy.side.direction);
    if (!isThrough || slant > -kMinLitSlant || length(seen - to) > farthest) return copy;
    Patch there = copy;
    for (int i = 0; i < 4; ++i) {
        float back = dot(normal, seen - copy.corners[i]) / slant;
        if (abs(back) > farthest) return copy;
        there.corners[i] += back * copy.side.direction;
    }
    there.side = PatchSide(normal, copy.side.direction, false);
    return there;
#else
    return copy;
#endif
}

// The patch with one of so many parts of the flux, as light from one place on the disc lays it.
Patch copyOf(Patch whole, Copies copies, int number) {
    if (copies.places == 1) return whole;
    // Half of them in a spiral of the golden angle (Vogel 1979), half across from those, so that the
    // mean is the middle.
    const float kGoldenAngle = 2.39996323;
    int pairs = copies.places / 2;
    float along = float(number % pairs);
    float radius = sqrt((along + 0.5) / float(pairs)) * (number < pairs ? 1.0 : -1.0);
    float angle = kGoldenAngle * along;
    vec2 place = radius * vec2(cos(angle), sin(angle));
    vec3 from = middleOf(whole);
    for (int i = 0; i < 4; ++i) whole.corners[i] += whole.spread[i] * place;
    whole.flux *= float(copies.stride) / float(copies.places);
    return landed(whole, from);
}
