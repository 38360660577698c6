// SPDX-License-Identifier: MIT
// The workgroups for so many patches: 64 threads each.
#include "reconstruct/triangles_patch_list.glsl"

layout(local_size_x = 1) in;

uniform int isWide;  // below 0: there are none yet
uniform int wideCapacity;
uniform int threadsOfPatch;  // of each that is not wide

void main() {
    if (isWide < 0) {
        for (uint kind = 0u; kind < kPatchKinds; ++kind) patches[kind].count = 0u;
        widePatches.count = 0u;
    } else if (isWide == 0) {
        for (uint kind = 0u; kind < kPatchKinds; ++kind)
            setGroups(patches[kind], uint(threadsOfPatch) * patches[kind].count);
    } else {
        // The others found no room and are covered already.
        widePatches.count = min(widePatches.count, uint(wideCapacity));
        setGroups(widePatches, kThreadsOfPatch * widePatches.count);
    }
}
