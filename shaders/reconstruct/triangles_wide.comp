// SPDX-License-Identifier: MIT
// reconstruct.triangles: a wide patch's flux onto the pixels that it covers. A workgroup a patch.
#include "reconstruct/triangles_patch.glsl"
#include "reconstruct/triangles_patch_deposit.glsl"

uniform int firstWide;
shared PatchParts partsOfThreads[64];

void main() {
    uint index = workgroupNumber();
    bool isHere = index < widePatches.count;
    Patch whole;
    Patch there;
    PatchOnScreen onto;
    PatchParts parts = PatchParts(0.0, 0.0, 0.0);
    ivec2 local = ivec2(gl_LocalInvocationIndex & 7u, gl_LocalInvocationIndex >> 3u);
    uint item = 0u;
    if (isHere) {
        item = patchList[uint(firstWide) + index];
        whole = patchOf(item);
        for (int face = 0; face < viewCount; ++face) {
            if (!seenInFace(whole, face, there, onto)) continue;
            for (int row = onto.low.y + local.y; row <= onto.high.y; row += 8) {
                ivec2 columns = columnsOf(onto, row);
                for (int column = columns.x + local.x; column <= columns.y; column += 8)
                    addPart(parts, patchAt(onto, ivec2(column, row)));
            }
        }
    }
    partsOfThreads[gl_LocalInvocationIndex] = parts;
    barrier();
    // Always in the same order.
    if (gl_LocalInvocationIndex == 0u) {
        for (int i = 1; i < 64; ++i) {
            parts.on += partsOfThreads[i].on;
            parts.occluded += partsOfThreads[i].occluded;
            parts.outside += partsOfThreads[i].outside;
        }
        float total = 0.0;
        if (isHere) {
            total = account(item, whole, viewCount > 1 || onto.isWhole, parts);
            if (total <= 0.0) depositNear(item, whole);
        }
        partsOfThreads[0].on = parts.on > 0.0 ? total : 0.0;
    }
    barrier();
    float total = partsOfThreads[0].on;
    if (!isHere || total <= 0.0) return;
    for (int face = 0; face < viewCount; ++face) {
        if (!seenInFace(whole, face, there, onto)) continue;
        for (int row = onto.low.y + local.y; row <= onto.high.y; row += 8) {
            ivec2 columns = columnsOf(onto, row);
            for (int column = columns.x + local.x; column <= columns.y; column += 8) {
                PatchPixel pixel = patchAt(onto, ivec2(column, row));
                if (pixel.where == kSeenOn && pixel.share > 0.0)
                    deposit(there, ivec2(column, row), pixel.share / total);
            }
        }
    }
}
