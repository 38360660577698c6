// SPDX-License-Identifier: MIT
// The workgroups for so many patches: 64 threads each.
#include "reconstruct/triangles_patch_list.glsl"

layout(local_size_x = 1) in;

const int kNone = 0;  // there are no patches yet
const int kListed = 1;
const int kCopied = 2;
const int kWide = 3;
uniform int listed;  // what has been, up to now

uniform int wideCapacity;  // of each kind

void main() {
    if (listed == kNone) {
        for (uint kind = 0u; kind < kPatchKinds; ++kind) {
            patches[kind].count = 0u;
            copiedPatches[kind].count = 0u;
        }
        for (uint kind = 0u; kind < kWideKinds; ++kind) widePatches[kind].count = 0u;
    } else if (listed == kListed) {
        for (uint kind = 0u; kind < kPatchKinds; ++kind)
            setGroups(patches[kind], patches[kind].count);
    } else if (listed == kCopied) {
        for (uint kind = 0u; kind < kPatchKinds; ++kind)
            setGroups(copiedPatches[kind], kThreadsOfCopies * copiedPatches[kind].count);
    } else {
        // The others found no room and are covered already.
        for (uint kind = 0u; kind < kWideKinds; ++kind) {
            widePatches[kind].count = min(widePatches[kind].count, uint(wideCapacity));
            setGroups(widePatches[kind], kThreadsOfPatch * widePatches[kind].count);
        }
    }
}
