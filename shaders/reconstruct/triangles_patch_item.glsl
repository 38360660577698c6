// SPDX-License-Identifier: MIT
// A patch of the list of its kind, and whether the view can see any of it.
#include "reconstruct/triangles_patch_made.glsl"
// What is joined has the width that it has, and OpenGL grants a program no more than eight blocks.
#ifndef JOINED_PATCHES
#include "include/photons/clamped.glsl"
#endif

#if defined(JOINED_PATCHES)
const uint kKind = kPatchesJoined;
#elif defined(CREASE_PATCHES)
const uint kKind = kPatchesAtCreases;
#else
const uint kKind = kPatchesOfBeams;
#endif

// False: it looks away, and its flux is booked.
bool isPatchSeen(uint item, out Patch whole) {
    whole = patchOf(item);
    ivec2 photon = ivec2(photonTexel(photons, item / kPatchParts));
#ifndef JOINED_PATCHES
    // What neighbours share out is covered in each of their batches, and counts in the photon's own.
    if (whole.narrowing > 1.0 && !isFromOtherBatch(originAt(photon)))
        countClamped(0u, whole.narrowing, whole.flux);
#endif
    uint material = uint(texelFetch(hitSurface, photon, 0).w);
    bool isSeen = !isOpen(material - 1u) ||
                  seesLitSide(whole.corners[0], whole.side.normal, whole.side.direction);
    if (!isSeen) ledgerAdd(kAccountHidden, whole.flux);
    return isSeen;
}
