// SPDX-License-Identifier: MIT
// reconstruct.triangles: small cells are merged, their power added (U08, section 5, its future
// work): four squares of joined cells that together cover no more than so many texels are one. Step
// 0 makes squares of single cells, steps 1 to kMaxMerges merge, the last one lists what is left.
// One thread an arrival.
#include "reconstruct/triangles_arrivals.glsl"
#include "reconstruct/triangles_patch_made.glsl"

layout(std430) readonly buffer CellJoins {
    uint cellJoins[];
};
uniform int mergeStep;

// Texels from one to the other are their difference.
vec3 texelPlace(uint photon) {
    vec3 position =
        pointFromEye(texelFetch(hitPosition, ivec2(photonTexel(photons, photon)), 0).xyz);
#ifdef MANY_VIEWS
    return normalize(position) * (0.5 * view.sizePixels.x);
#else
    return vec3(pixelOf(position), 0.0);
#endif
}

PatchBlock blockOfCell(uint index) {
    PatchBlock block = PatchBlock(vec4(0.0, 0.0, 0.0, -1.0), vec4(0.0), vec4(0.0));
    if (cellJoins[index] == 0u) return block;
    PhotonOrigin origin = originAt(ivec2(photonTexel(photons, index)));
    block.flux = vec4(patchOfCells(index, 1).flux, 0.0);
    vec3 low = vec3(3.0e38);
    vec3 high = vec3(-3.0e38);
    for (int i = 0; i < 4; ++i) {
        vec3 place = texelPlace(neighbourOf(origin, ivec2(i & 1, i >> 1)));
        low = min(low, place);
        high = max(high, place);
    }
    block.low = vec4(low, 0.0);
    block.high = vec4(high, 0.0);
    return block;
}

void merge(uint index) {
    int merges = mergeStep;
    PhotonOrigin origin = originAt(ivec2(photonTexel(photons, index)));
    uint side = 1u << merges;
    uvec2 cell = uvec2(origin.cell % uint(cellGrid.x), origin.cell / uint(cellGrid.x));
    if (any(notEqual(cell % side, uvec2(0u)))) return;
    uint parts[4];
    PatchBlock whole = PatchBlock(vec4(0.0), vec4(3.0e38), vec4(-3.0e38));
    for (int i = 0; i < 4; ++i) {
        uint found = neighbourAt(origin, ivec2(i & 1, i >> 1) * int(side / 2u));
        if (found == 0u) return;
        parts[i] = found - 1u;
        PatchBlock part = blocks[parts[i]];
        if (part.flux.w != float(merges - 1)) return;
        whole.flux += part.flux;
        whole.low = min(whole.low, part.low);
        whole.high = max(whole.high, part.high);
    }
    vec3 size = whole.high.xyz - whole.low.xyz;
    if (!(max(size.x, max(size.y, size.z)) <= reconstruct_triangles_merge)) return;
    for (int i = 1; i < 4; ++i) blocks[parts[i]].flux.w = -1.0;
    whole.flux.w = float(merges);
    blocks[index] = whole;
}

void main() {
    uint index;
    if (!arrivalOfThread(index)) return;
    if (mergeStep == 0) {
        blocks[index] = blockOfCell(index);
    } else if (mergeStep <= int(kMaxMerges)) {
        if (blocks[index].flux.w >= 0.0) merge(index);
    } else if (blocks[index].flux.w >= 0.0 && arrivedShare(ivec2(photonTexel(photons, index))) > 0.0 &&
               !isFromOtherBatch(originAt(ivec2(photonTexel(photons, index))))) {
        uint merges = uint(blocks[index].flux.w);
        uint part = merges == 0u ? kPatchJoined : kPatchMerged + merges - 1u;
        patchList[atomicAdd(patches[kPatchesJoined].count, 1u)] = index * kPatchParts + part;
    }
}
