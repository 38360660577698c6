// SPDX-License-Identifier: MIT
// reconstruct.triangles: a wide patch's flux onto the pixels that it covers, or, of a beam with no
// joined neighbour, onto squares of them (PIXEL_BLOCKS). Eight threads a patch, which take its lines
// of pixels, or of squares, in turn: with more, what there is to do once a patch outweighs them, since
// most patches that are wide are slivers.
#include "include/thread.glsl"
#include "reconstruct/triangles_patch_deposit.glsl"
#include "reconstruct/triangles_patch_list.glsl"
#include "reconstruct/triangles_wide.glsl"
#ifdef PIXEL_BLOCKS
#include "reconstruct/triangles_pixel_blocks.glsl"
#endif

const int kThreads = int(kThreadsOfPatch);
shared PatchParts partsOfThreads[64];

#ifdef PIXEL_BLOCKS
// What a block has that shows more than one surface, pixel by pixel.
void addPartsOfBlock(PatchOnScreen onto, ivec2 corner, inout PatchParts parts) {
    ivec2 low = max(corner, onto.low);
    ivec2 high = min(corner + kBlockSide - 1, onto.high);
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) addPart(parts, patchAt(onto, ivec2(x, y)));
    }
}

void addPartsOfBlocks(PatchOnScreen onto, int thread, inout PatchParts parts) {
    PatchLines lines = linesOf(onto);
    int last = lines.high.y / kBlockSide;
    for (int line = lines.low.y / kBlockSide + thread; line <= last; line += kThreads) {
        ivec2 span = blockSpanOf(lines, line);
        for (int place = span.x; place <= span.y; ++place) {
            ivec2 corner;
            vec4 receiver = pixelBlocks[blockOnLine(lines, line, place, corner)].receiver;
            if (receiver.y < 0.0) {
                addPartsOfBlock(onto, corner, parts);
            } else {
                addPart(parts, patchAtBlock(onto, corner, receiver));
            }
        }
    }
}

// As sumAddTo() adds to a map.
void addToBlock(int block, int channel, float units) {
    uvec2 words = wordsOfUnits(units);
    if (words == uvec2(0u)) return;
    uint above = highAddend(words, atomicAdd(pixelBlocks[block].sums[2 * channel], words.x));
    if (above > 0u) atomicAdd(pixelBlocks[block].sums[2 * channel + 1], above);
}

void depositOnBlocks(Patch whole, PatchOnScreen onto, int thread, float total) {
    PatchLines lines = linesOf(onto);
    int last = lines.high.y / kBlockSide;
    float excess = 0.0;
    for (int line = lines.low.y / kBlockSide + thread; line <= last; line += kThreads) {
        ivec2 span = blockSpanOf(lines, line);
        for (int place = span.x; place <= span.y; ++place) {
            ivec2 corner;
            int block = blockOnLine(lines, line, place, corner);
            vec4 receiver = pixelBlocks[block].receiver;
            if (receiver.y >= 0.0) {
                PlanePixel part = patchAtBlock(onto, corner, receiver);
                vec3 units = whole.flux * (part.stored / total * ledgerUnitsPerWatt);
                for (int channel = 0; channel < 3; ++channel)
                    addToBlock(block, channel, units[channel]);
                excess += part.stored - part.lit;
                continue;
            }
            ivec2 low = max(corner, onto.low);
            ivec2 high = min(corner + kBlockSide - 1, onto.high);
            for (int y = low.y; y <= high.y; ++y) {
                for (int x = low.x; x <= high.x; ++x)
                    depositAt(whole, onto, ivec2(x, y), total, excess);
            }
        }
    }
    bookMapExcess(whole, excess / total);
}
#endif

void addPartsOfThread(Patch whole, PatchOnScreen onto, int thread, inout PatchParts parts) {
#ifdef PIXEL_BLOCKS
    if (whole.isAlone) {
        addPartsOfBlocks(onto, thread, parts);
        return;
    }
#endif
    addParts(onto, thread, kThreads, parts);
}

void depositOfThread(Patch whole, PatchOnScreen onto, int thread, float total) {
#ifdef PIXEL_BLOCKS
    if (whole.isAlone) {
        depositOnBlocks(whole, onto, thread, total);
        return;
    }
#endif
    depositParts(whole, onto, thread, kThreads, total);
}

void main() {
    uint index = threadNumber() / kThreadsOfPatch;
    bool isHere = index < widePatches.count;
    Patch whole = unpackedPatch(widePatchList[isHere ? index : 0u]);
    Patch there;
    PatchOnScreen onto;
    PatchParts parts = PatchParts(0.0, 0.0, 0.0);
    int thread = int(gl_LocalInvocationIndex) % kThreads;
    for (int face = 0; face < viewCount && isHere; ++face) {
        if (seenInFace(whole, face, there, onto)) addPartsOfThread(there, onto, thread, parts);
    }
    partsOfThreads[gl_LocalInvocationIndex] = parts;
    barrier();
    // Always in the same order, each for itself.
    int first = int(gl_LocalInvocationIndex) - thread;
    parts = partsOfThreads[first];
    for (int i = 1; i < kThreads; ++i) {
        parts.on += partsOfThreads[first + i].on;
        parts.occluded += partsOfThreads[first + i].occluded;
        parts.inView += partsOfThreads[first + i].inView;
    }
    if (!isHere) return;
    PatchBalance balance = balanceOf(parts, viewCount > 1 || onto.isWhole);
    if (thread == 0) {
        account(whole, balance);
        if (balance.total <= 0.0) depositNear(whole);
    }
    if (balance.on <= 0.0) return;
    for (int face = 0; face < viewCount; ++face) {
        if (seenInFace(whole, face, there, onto))
            depositOfThread(there, onto, thread, balance.total);
    }
}
