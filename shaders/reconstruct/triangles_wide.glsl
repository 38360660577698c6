// SPDX-License-Identifier: MIT
// Patches that are made once and kept for those who cover them: several threads, where they cover many
// pixels, or the processor.
#include "reconstruct/triangles_patch.glsl"
#include "reconstruct/triangles_patch_list.glsl"

layout(std430) buffer WidePatches {
    PatchData widePatchList[];
};

// Where a wide beam ends is known no better than by a square of pixels, unless something is joined
// next to it or a border is known (isAlone).
uint kindOfWide(Patch whole) {
#ifdef PIXEL_BLOCKS
    if (whole.isAlone) return kWideToSquares;
#endif
    return kWideToPixels;
}

PatchData packedPatch(Patch whole) {
    PatchData made;
    for (int i = 0; i < 4; ++i) made.corners[i] = vec4(whole.corners[i], whole.densities[i]);
    made.normal = vec4(whole.side.normal, whole.first);
    made.direction = vec4(whole.side.direction, whole.tolerance);
    uint bits = (whole.isJoined ? kPatchIsJoined : 0u) |
                (whole.side.isFromBehind ? kPatchIsFromBehind : 0u) |
                (whole.isAlone ? kPatchIsAlone : 0u);
    made.flux = vec4(whole.flux, float(bits));
    return made;
}

Patch unpackedPatch(PatchData from) {
    Patch made;
    for (int i = 0; i < 4; ++i) {
        made.corners[i] = from.corners[i].xyz;
        made.densities[i] = from.corners[i].w;
    }
    uint bits = uint(from.flux.w);
    made.side =
        PatchSide(from.normal.xyz, from.direction.xyz, (bits & kPatchIsFromBehind) != 0u);
    made.first = from.normal.w;
    made.tolerance = from.direction.w;
    made.flux = from.flux.rgb;
    made.isJoined = (bits & kPatchIsJoined) != 0u;
    made.isAlone = false;  // its list says so
    made.narrowing = 1.0;
    return made;
}
