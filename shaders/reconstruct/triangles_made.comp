// SPDX-License-Identifier: MIT
// reconstruct.triangles: the patches of one kind, for the processor, which covers them
// (techniques/reconstruct/processor_patches.h). One thread a patch.
#include "include/photons/ledger_of_group.glsl"
#include "reconstruct/triangles_patch_item.glsl"
#include "reconstruct/triangles_wide.glsl"

uniform int listCapacity;
// Where the first of the kind stands among all that are made at once, of which there is room for so
// many; those before and after are made another time.
uniform int firstPlace;
uniform int placeCount;

void threadMain() {
    uint index = threadNumber();
    if (index >= patches[kKind].count) return;
    int place = int(index) + firstPlace;
    if (place < 0 || place >= placeCount) return;
    Patch whole;
    bool isSeen = isPatchSeen(patchList[patchPlace(kKind, index, uint(listCapacity))], whole);
    PatchData made = packedPatch(whole);
    if (!isSeen) made.flux = vec4(vec3(0.0), float(kPatchIsNone));
    widePatchList[place] = made;
}
