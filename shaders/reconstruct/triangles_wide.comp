// SPDX-License-Identifier: MIT
// reconstruct.triangles: a wide patch's flux onto the pixels that it covers, or, of a beam with no
// joined neighbour, onto squares of them (WALKS_BLOCKS). Eight threads a patch, which take its lines
// of pixels, or of squares, in turn: with more, what there is to do once a patch outweighs them, since
// most patches that are wide are slivers.
#include "include/thread.glsl"
#include "reconstruct/triangles_cover.glsl"
#include "reconstruct/triangles_patch_list.glsl"
#include "reconstruct/triangles_wide.glsl"

#ifdef WALKS_BLOCKS
const uint kKind = kWideToSquares;
#else
const uint kKind = kWideToPixels;
#endif

uniform int wideCapacity;

const int kThreads = int(kThreadsOfPatch);
shared PatchParts partsOfThreads[64];

// By all threads of a workgroup at once: of the patch's, always in the same order.
PatchParts partsOfPatch(PatchParts own, int thread) {
    partsOfThreads[gl_LocalInvocationIndex] = own;
    barrier();
    int first = int(gl_LocalInvocationIndex) - thread;
    PatchParts parts = partsOfThreads[first];
    for (int i = 1; i < kThreads; ++i) {
        parts.on += partsOfThreads[first + i].on;
        parts.occluded += partsOfThreads[first + i].occluded;
        parts.inView += partsOfThreads[first + i].inView;
    }
    return parts;
}

void main() {
    uint index = threadNumber() / kThreadsOfPatch;
    bool isHere = index < widePatches[kKind].count;
    Patch whole =
        unpackedPatch(widePatchList[widePlace(kKind, isHere ? index : 0u, uint(wideCapacity))]);
    Patch there;
    PatchOnScreen onto;
    Found found = nothingFound();
    int thread = int(gl_LocalInvocationIndex) % kThreads;
    for (int face = 0; face < viewCount && isHere; ++face) {
        if (seenInFace(whole, face, there, onto)) findParts(onto, thread, kThreads, found);
    }
    PatchParts parts = partsOfPatch(found.parts, thread);
    PatchBalance balance = PatchBalance(0.0, 0.0, 0.0, 0.0);
    if (isHere) balance = balanceOf(parts, viewCount > 1 || onto.isWhole);
    bool isDeposited = balance.on > 0.0;
    if (isHere && thread == 0) {
        account(whole, balance);
        if (balance.total <= 0.0) depositNear(whole);
    }
    if (isDeposited) bookMapExcess(whole, found.excess / balance.total);
    for (int face = 0; face < viewCount && isDeposited; ++face) {
        if (seenInFace(whole, face, there, onto))
            depositRest(there, onto, thread, kThreads, balance.total, found);
    }
#ifndef MANY_VIEWS
    depositKept(whole, isDeposited ? balance.total : 0.0, found);
#endif
}
