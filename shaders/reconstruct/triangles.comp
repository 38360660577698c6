// SPDX-License-Identifier: MIT
// reconstruct.triangles: a patch's flux onto the pixels that it covers, on every face that sees a
// part of it. One thread a patch of one kind (triangles_patch_made.glsl); those that cover many pixels
// go to a list of their own, as long as there is room.
#include "include/photons/ledger_of_group.glsl"
#include "reconstruct/triangles_patch_item.glsl"
#include "reconstruct/triangles_cover.glsl"
#ifdef LIGHT_SPREAD
#include "reconstruct/triangles_spread.glsl"
#endif
#include "reconstruct/triangles_wide.glsl"

uniform int wideCapacity;
uniform int listCapacity;

// What the shares that are to be deposited add up to; 0: none are.
float findPatch(Patch whole, out Found found) {
    found = nothingFound();
#ifndef MANY_VIEWS
    if (!isBeforeView(whole)) {
        ledgerAdd(kAccountBehind, whole.flux);
        return 0.0;
    }
#endif
    Patch there;
    PatchOnScreen onto;
    uint faces = 0u;
    int pixels = 0;
    for (int face = 0; face < viewCount; ++face) {
        if (!seenInFace(whole, face, there, onto)) continue;
        faces |= 1u << face;
        ivec2 size = max(onto.high - onto.low + 1, ivec2(0));
        pixels += size.x * size.y;
    }
    if (pixels > kMaxPixelsOfNarrow) {
        uint kind = kindOfWide(whole);
        uint number = atomicAdd(widePatches[kind].count, 1u);
        if (number < uint(wideCapacity)) {
            widePatchList[widePlace(kind, number, uint(wideCapacity))] = packedPatch(whole);
            return 0.0;
        }
    }
    for (int face = 0; face < viewCount; ++face) {
        if ((faces & (1u << face)) == 0u) continue;
        if (viewCount > 1) seenInFace(whole, face, there, onto);
        findParts(onto, 0, 1, found);
    }
    // The faces of a cube see in all directions.
    PatchBalance balance = balanceOf(found.parts, viewCount > 1 || onto.isWhole);
    account(whole, balance);
    if (balance.total <= 0.0) depositNear(whole);
    if (balance.on <= 0.0) return 0.0;
    bookMapExcess(whole, found.excess / balance.total);
    for (int face = 0; face < viewCount; ++face) {
        if ((faces & (1u << face)) == 0u) continue;
        if (viewCount > 1) seenInFace(whole, face, there, onto);
        depositRest(there, onto, 0, 1, balance.total, found);
    }
    return balance.total;
}

#ifdef LIGHT_SPREAD
// By the photon's number where it is of no grid, which no batch changes either.
Copies copiesOfPatch(Patch whole, ivec2 photon) {
    PhotonOrigin origin = originAt(photon);
    ivec2 cell = cellGrid.x > 0 ? cellOf(origin) : ivec2(origin.cell % 8u, origin.cell / 8u);
    return copiesOf(whole, cell);
}
#endif

#ifdef COPIES
// `thread`: of those that share a patch's copies.
void coverCopies(uint item, uint thread) {
    Patch whole = patchOf(item);
    Copies copies = copiesOfPatch(whole, ivec2(photonTexel(photons, item / kPatchParts)));
    int step = copies.stride * int(kThreadsOfCopies);
    for (int i = copies.first + copies.stride * int(thread); i < copies.places; i += step) {
        Patch copy = copyOf(whole, copies, i);
        Found found;
        float total = findPatch(copy, found);
#ifndef MANY_VIEWS
        depositKept(copy, total, found);
#endif
    }
}

void threadMain() {
    uint index = threadNumber() / kThreadsOfCopies;
    if (index < copiedPatches[kKind].count) {
        coverCopies(patchList[copiedPatchPlace(kKind, index, uint(listCapacity))],
                    threadNumber() % kThreadsOfCopies);
    }
}
#else
// As findPatch().
float findItem(uint item, out Patch whole, out Found found) {
    found = nothingFound();
    if (!isPatchSeen(item, whole)) return 0.0;
#ifdef LIGHT_SPREAD
    ivec2 photon = ivec2(photonTexel(photons, item / kPatchParts));
    if (copiesOfPatch(whole, photon).places > 1) {
        uint number = atomicAdd(copiedPatches[kKind].count, 1u);
        patchList[copiedPatchPlace(kKind, number, uint(listCapacity))] = item;
        return 0.0;
    }
#endif
    return findPatch(whole, found);
}

void threadMain() {
    Patch whole;
    Found found = nothingFound();
    float total = 0.0;
    uint index = threadNumber();
    if (index < patches[kKind].count)
        total = findItem(patchList[patchPlace(kKind, index, uint(listCapacity))], whole, found);
#ifndef MANY_VIEWS
    depositKept(whole, total, found);
#endif
}
#endif
