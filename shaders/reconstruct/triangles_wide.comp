// SPDX-License-Identifier: MIT
// reconstruct.triangles: a wide patch's flux onto the pixels that it covers, or, of a beam with no
// joined neighbour, onto squares of them (PIXEL_BLOCKS). Eight threads a patch, which take its lines
// of pixels, or of squares, in turn: with more, what there is to do once a patch outweighs them, since
// most patches that are wide are slivers.
#include "include/thread.glsl"
#ifdef PIXEL_BLOCKS
#define WALKS_BLOCKS
#endif
#include "reconstruct/triangles_cover.glsl"
#include "reconstruct/triangles_patch_list.glsl"
#include "reconstruct/triangles_wide.glsl"

const int kThreads = int(kThreadsOfPatch);
shared PatchParts partsOfThreads[64];

void main() {
    uint index = threadNumber() / kThreadsOfPatch;
    bool isHere = index < widePatches.count;
    Patch whole = unpackedPatch(widePatchList[isHere ? index : 0u]);
    Patch there;
    PatchOnScreen onto;
    Found found = nothingFound();
    int thread = int(gl_LocalInvocationIndex) % kThreads;
    for (int face = 0; face < viewCount && isHere; ++face) {
        if (seenInFace(whole, face, there, onto)) findParts(there, onto, thread, kThreads, found);
    }
    partsOfThreads[gl_LocalInvocationIndex] = found.parts;
    barrier();
    // Always in the same order, each for itself.
    int first = int(gl_LocalInvocationIndex) - thread;
    PatchParts parts = partsOfThreads[first];
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
    bookMapExcess(whole, found.excess / balance.total);
    for (int face = 0; face < viewCount; ++face) {
        if (seenInFace(whole, face, there, onto))
            depositParts(there, onto, thread, kThreads, balance.total, found);
    }
}
