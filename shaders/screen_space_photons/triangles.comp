// SPDX-License-Identifier: MIT
// reconstruct.triangles: a patch's flux onto the pixels that it covers. One thread a patch; those
// that cover many pixels go to a list of their own.
#include "screen_space_photons/patch.glsl"
#include "screen_space_photons/patch_deposit.glsl"

layout(std430) readonly buffer Patches {
    uint patchList[];
};
layout(std430) writeonly buffer WidePatches {
    uint widePatchList[];
};

// Pixels of the rectangle around a patch for one thread.
const int kMostOfThread = 400;

void cover(uint item) {
    Patch whole = patchOf(item);
    uint material = uint(texelFetch(hitSurface, ivec2(photonTexel(photons, item / kPatchParts)), 0).w);
    if (isOpen(material - 1u) && 
        !seesLitSide(whole.corners[0], whole.normal, whole.direction)) {
        ledgerAdd(kAccountHidden, whole.flux);
        return;
    }
    if (!isBeforeView(whole)) {
        ledgerAdd(kAccountBehind, whole.flux);
        return;
    }
    PatchOnScreen onto = onScreen(whole);
    ivec2 size = onto.high - onto.low + 1;
    if (size.x > 0 && size.y > 0 && size.x * size.y > kMostOfThread) {
        widePatchList[atomicAdd(widePatches.count, 1u)] = item;
        return;
    }
    PatchParts parts = PatchParts(0.0, 0.0, 0.0);
    for (int row = onto.low.y; row <= onto.high.y; ++row) {
        ivec2 columns = columnsOf(onto, row);
        for (int column = columns.x; column <= columns.y; ++column)
            addPart(parts, patchAt(onto, ivec2(column, row)));
    }
    float total = account(whole, onto, parts);
    if (total <= 0.0) depositNear(whole, onto);
    if (parts.on <= 0.0) return;
    for (int row = onto.low.y; row <= onto.high.y; ++row) {
        ivec2 columns = columnsOf(onto, row);
        for (int column = columns.x; column <= columns.y; ++column) {
            PatchPixel pixel = patchAt(onto, ivec2(column, row));
            if (pixel.where == kSeenOn && pixel.share > 0.0)
                deposit(whole, ivec2(column, row), pixel.share / total);
        }
    }
}

void main() {
    uint index = photonOfThread();
    if (index < patches.count) cover(patchList[index]);
}
