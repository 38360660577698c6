// SPDX-License-Identifier: MIT
// The places that a patch may cover, one after another: pixels on its lines, of those where a surface
// ends each quarter, or (WALKS_BLOCKS) squares of pixels. One loop over all of them and not one within
// another, since threads that run side by side wait in each for whichever goes on the longest; and it
// asks at its end whether there is more, since a software rasteriser can't leave it before.
#include "reconstruct/triangles_patch.glsl"
#ifdef WALKS_BLOCKS
#include "reconstruct/triangles_pixel_blocks.glsl"
#endif

struct Walk {
    PatchLines lines;
    int line;
    int last;
    int step;    // to the next of its lines
    ivec2 span;  // of the line
    int place;   // on it
    ivec2 pixel;
    PixelParts parts;
    int part;
#ifdef WALKS_BLOCKS
    vec4 receiver;  // of the square that the pixel is the corner of, or one of
#endif
};

#ifdef WALKS_BLOCKS
// The squares on a line of them, first and last, that a patch can cover; none where x > y.
ivec2 blockSpanOf(PatchLines lines, int line) {
    vec2 heights = vec2(kPixelBlockSide * line - lines.base.y) + vec2(0.0, kPixelBlockSide);
    vec2 span = vec2(1e9, -1e9);
    span = spanWith(spanWith(span, lines.first, heights), lines.second, heights);
    if (span.x > span.y) return ivec2(1, 0);
    ivec2 pixels = ivec2(floor(span)) + lines.base.x;
    return ivec2(max(pixels.x, lines.low.x), min(pixels.y, lines.high.x)) / kPixelBlockSide;
}
#endif

// Over every `step`th line from the first one on; goOn() brings it to the first place.
Walk walkOver(PatchOnScreen onto, int first, int step) {
    Walk walk;
    walk.lines = linesOf(onto);
    walk.line = walk.lines.low.y;
    walk.last = walk.lines.high.y;
    walk.pixel = ivec2(0);
    walk.parts = PixelParts(1, 1.0, 0u, vec2(0.0));
    walk.part = 0;
#ifdef WALKS_BLOCKS
    walk.line /= kPixelBlockSide;
    walk.last /= kPixelBlockSide;
    walk.receiver = vec4(0.0);
#endif
    walk.line += first - step;
    walk.step = step;
    walk.span = ivec2(1, 0);
    walk.place = 1;
    return walk;
}

// Whether it is at a square that shows one surface.
bool isAtBlock(Walk walk) {
#ifdef WALKS_BLOCKS
    return walk.receiver.y >= 0.0;
#else
    return false;
#endif
}

#ifdef WALKS_BLOCKS
// To the next pixel of a square that shows several surfaces; false: it has no other.
bool goOnInBlock(inout Walk walk, PatchOnScreen onto) {
    if (isAtBlock(walk)) return false;
    ivec2 corner = walk.pixel / kPixelBlockSide * kPixelBlockSide;
    ivec2 high = min(corner + kPixelBlockSide - 1, onto.high);
    if (walk.pixel.x < high.x) {
        ++walk.pixel.x;
    } else if (walk.pixel.y < high.y) {
        walk.pixel = ivec2(max(corner.x, onto.low.x), walk.pixel.y + 1);
    } else {
        return false;
    }
    walk.parts = partsOf(walk.pixel);
    return true;
}
#endif

ivec2 spanOf(Walk walk) {
#ifdef WALKS_BLOCKS
    return blockSpanOf(walk.lines, walk.line);
#else
    return spanOf(walk.lines, walk.line);
#endif
}

// False: it has been everywhere.
bool goOn(inout Walk walk, PatchOnScreen onto) {
    ++walk.part;
    if (walk.part < walk.parts.count) return true;
    walk.part = 0;
#ifdef WALKS_BLOCKS
    if (goOnInBlock(walk, onto)) return true;
#endif
    ++walk.place;
    do {
        if (walk.place > walk.span.y) {
            walk.line += walk.step;
            if (walk.line > walk.last) return false;
            walk.span = spanOf(walk);
            walk.place = walk.span.x;
        }
    } while (walk.place > walk.span.y);
    walk.pixel = pixelOnLine(walk.lines, walk.line, walk.place);
#ifdef WALKS_BLOCKS
    walk.pixel *= kPixelBlockSide;
    walk.receiver = pixelBlocks[blockAt(walk.pixel)].receiver;
    walk.parts = PixelParts(1, 1.0, 0u, walk.receiver.xy);
    if (isAtBlock(walk)) return true;
    walk.pixel = max(walk.pixel, onto.low);
#endif
    walk.parts = partsOf(walk.pixel);
    return true;
}

// Whether nothing is left of the pixel or square that it is at.
bool isAtLastPart(Walk walk) { return walk.part == walk.parts.count - 1; }

// What a patch has of the place.
void addPlace(PatchOnScreen onto, Walk walk, inout PlanePixel sum) {
    float side = walk.parts.side;
    vec2 corner = vec2(walk.pixel - onto.base) + cornerOfPart(walk.parts, walk.part);
#ifdef WALKS_BLOCKS
    if (isAtBlock(walk)) {
        side = float(kPixelBlockSide);
        corner = vec2(walk.pixel - onto.base);
    }
#endif
    float first = partOf(onto.first, corner, side);
    float second = partOf(onto.second, corner, side);
    if (first + second <= 0.0) return;
    bool isFirst = first >= second;
    vec2 place;
    vec3 normal;
    vec2 seen;
#ifdef WALKS_BLOCKS
    if (isAtBlock(walk)) {
        place = vec2(0.5 * side);
        seen = walk.receiver.xy;
        normal = unpackUnitVector(walk.receiver.zw);
    } else
#endif
    {
        seen = receiverOfPart(walk.pixel, walk.parts, walk.part, place, normal);
    }
    addSeen(sum, vec2(walk.pixel) + place, seen, normal,
            isFirst ? onto.first.plane : onto.second.plane,
            isFirst ? onto.first.middle : onto.second.middle,
            isFirst ? onto.first.isShaded : onto.second.isShaded, onto.side, onto.tolerance,
            isAwayFrom(onto, walk.parts, vec2(walk.pixel - onto.base) + place),
            (first + second) * side * side, walk.parts.middle.y);
}
