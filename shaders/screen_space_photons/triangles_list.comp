// SPDX-License-Identifier: MIT
// reconstruct.triangles: what there is to cover. A photon stands for a quarter of each of the four
// quadrilaterals around it; those that are not joined it covers by its own beam, as far as light
// comes that way. One thread a photon.
#include "screen_space_photons/arrival.glsl"
#include "screen_space_photons/patch_list.glsl"

layout(std430) readonly buffer CellPhotons {
    uint cellPhotons[];
};
layout(std430) readonly buffer CellJoins {
    uint cellJoins[];
};
layout(std430) buffer PatchCounts {
    PatchCount patches;
    PatchCount widePatches;
};
layout(std430) writeonly buffer PhotonShares {
    float photonShares[];
};
layout(std430) writeonly buffer Patches {
    uint patchList[];
};

bool isJoined(PhotonOrigin origin, ivec2 corner) {
    uint place = cellPlace(origin, corner);
    uint found = place == kNoCell ? 0u : cellPhotons[place];
    return found > 0u && cellJoins[found - 1u] == 1u;
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    vec4 flux = texelFetch(hitFlux, texel, 0);
    if (uint(flux.w) != kFateReceiver) return;
    PhotonOrigin origin = originAt(texel);
    // By the lower left corner of each.
    bool joined[4];
    uint beams = 0u;
    for (int i = 0; i < 4; ++i) {
        joined[i] = isJoined(origin, ivec2((i & 1) - 1, (i >> 1) - 1));
        beams += joined[i] ? 0u : 1u;
    }
    // A cell of its own is covered at once.
    bool isAlone = beams == 4u && extentOf(origin) == uvec2(0u);
    // What the parts that light can come through take is all of its flux.
    float whole = 4.0;
    if (beams > 0u && !isAlone) {
        Arrival own = arrivalOf(texel);
        for (uint i = 0u; i < 4u; ++i) {
            if (!joined[i]) whole += quarterShare(own, i) - 1.0;
        }
    }
    photonShares[index] = whole > 0.0 ? 1.0 / whole : 0.0;
    if (isOfOtherBatch(flux.rgb)) beams = 0u;
    bool isCorner = joined[3];
    uint parts = (isAlone && beams > 0u ? 1u : beams) + (isCorner ? 1u : 0u);
    if (parts == 0u) return;
    uint at = atomicAdd(patches.count, parts);
    if (isCorner) patchList[at++] = index * kPatchParts + kPatchJoined;
    if (beams > 0u && isAlone) {
        patchList[at] = index * kPatchParts + kPatchBeam;
    } else if (beams > 0u) {
        for (uint i = 0u; i < 4u; ++i) {
            if (!joined[i]) patchList[at++] = index * kPatchParts + kPatchQuarter + i;
        }
    }
}
