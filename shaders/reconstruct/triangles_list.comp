// SPDX-License-Identifier: MIT
// reconstruct.triangles: what there is to cover. A photon stands for a quarter of each of the four
// quadrilaterals around it; those that are not joined it covers by its own beam, as far as light
// comes that way. What lies between photons of two batches is listed in the one that has the photon
// at the lower left. One thread an arrival.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/arriving.glsl"
#include "reconstruct/triangles_arrivals.glsl"
#include "reconstruct/triangles_crease.glsl"
#include "reconstruct/triangles_patch_list.glsl"

layout(std430) readonly buffer CellJoins {
    uint cellJoins[];
};
uniform int listCapacity;
layout(std430) writeonly buffer PhotonShares {
    VertexShares photonShares[];
};

// The photon and those of the cells around its own, row by row; index + 1, 0 where there is none.
struct Neighbourhood {
    uint photons[9];
};
Neighbourhood neighbourhoodOf(PhotonOrigin origin) {
    Neighbourhood around;
    for (int i = 0; i < 9; ++i)
        around.photons[i] = neighbourAt(origin, ivec2(i % 3, i / 3) - 1);
    return around;
}

// The photons at the corners of the quadrilateral towards `quarter`; false where one is missing.
bool photonsTowards(Neighbourhood around, uint quarter, out uint found[4]) {
    uint first = (quarter & 1u) + 3u * (quarter >> 1u);
    bool isWhole = true;
    for (uint i = 0u; i < 4u; ++i) {
        found[i] = around.photons[first + (i & 1u) + 3u * (i >> 1u)];
        isWhole = isWhole && found[i] > 0u;
    }
    return isWhole;
}

// The areas of the triangles that the photon is a corner of, in cells that are joined: bits by the
// corner of its cell (U08, section 5: in a pass of its own, once a photon).
void addAreas(Neighbourhood around, uint joined, inout VertexShares shares) {
    for (uint i = 0u; i < 4u; ++i) {
        if ((joined & (1u << i)) == 0u) continue;
        uint found[4];
        photonsTowards(around, i, found);
        vec3 corners[4];  // around the cell, from its lower left
        for (uint k = 0u; k < 4u; ++k) {
            uint corner = found[k ^ (k >> 1u)];
            corners[k] = texelFetch(hitPosition, ivec2(photonTexel(photons, corner - 1u)), 0).xyz;
        }
        // Triangles 0 1 2 and 0 2 3; the photon is the corner across from `i`.
        vec2 areas = 0.5 * vec2(length(cross(corners[1] - corners[0], corners[2] - corners[0])),
                                length(cross(corners[2] - corners[0], corners[3] - corners[0])));
        uint own = i ^ 3u;
        bool isOfFirst = own != 2u;
        bool isOfSecond = own != 1u;
        shares.area += (isOfFirst ? areas.x : 0.0) + (isOfSecond ? areas.y : 0.0);
        shares.triangles += (isOfFirst ? 1.0 : 0.0) + (isOfSecond ? 1.0 : 0.0);
        shares.cells += 1.0;
    }
}

// What of an arrival says which surface it is on.
struct Landing {
    uint path;
    uint material;
    vec3 normal;
};
Landing landingOf(uint photon) {
    ivec2 texel = ivec2(photonTexel(photons, photon));
    vec4 surface = texelFetch(hitSurface, texel, 0);
    return Landing(originAt(texel).path, uint(surface.w), surface.xyz);
}

// Whether the light of four neighbours comes down on more than one surface.
bool isAtCrease(Neighbourhood around, uint quarter) {
    uint found[4];
    if (!photonsTowards(around, quarter, found)) return false;
    Landing first = landingOf(found[0] - 1u);
    bool isOne = true;
    for (uint i = 1u; i < 4u; ++i) {
        Landing corner = landingOf(found[i] - 1u);
        if (corner.path != first.path) return false;
        isOne = isOne && corner.material == first.material && dot(corner.normal, first.normal) >= 0.5;
    }
    return !isOne;
}

void list(uint index, uint part, uint kind) {
    uint place = patchPlace(kind, atomicAdd(patches[kind].count, 1u), uint(listCapacity));
    patchList[place] = index * kPatchParts + part;
}

void threadMain() {
    uint index;
    if (!arrivalOfThread(index)) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    vec4 flux = texelFetch(hitFlux, texel, 0);
    // What other maps alone list and book may be a corner of what this one does.
    float ofMap = arrivedShare(texel);
    PhotonOrigin origin = originAt(texel);
    bool isOther = isFromOtherBatch(origin);
    Neighbourhood around = neighbourhoodOf(origin);
    Arrival own = arrivalOf(texel);
    // By the corner: those that are joined, and what is listed of the rest.
    uint joined = 0u;
    uint parts[4];
    uint count = 0u;
    float whole = 0.0;
    float discarded = 0.0;
    bool isPlain = true;
    for (uint i = 0u; i < 4u; ++i) {
        uint lowerLeft = around.photons[(i & 1u) + 3u * (i >> 1u)];
        if (lowerLeft > 0u && cellJoins[lowerLeft - 1u] == 1u) {
            joined |= 1u << i;
            whole += 1.0;
            continue;
        }
        bool isCrease = !isLeftOut(own, i) && isAtCrease(around, i);
        isPlain = isPlain && !isCrease && own.extent == uvec2(0u);
        float area = areaOf(cornersOf(own, i));
        whole += area;
        bool isListed = isCrease || area > 0.0;
        if (reconstruct_triangles_unjoined == reconstruct_triangles_unjoined_discard) {
            discarded += area;
        } else if (isListed) {
            parts[count++] = (isCrease ? kPatchCrease : kPatchQuarter) + i;
        }
    }
    // What the parts that light can come through take is all of its flux.
    VertexShares shares = VertexShares(whole > 0.0 ? 1.0 / whole : 0.0, 0.0, 0.0, 0.0);
    if (reconstruct_triangles_shading == reconstruct_triangles_shading_vertices)
        addAreas(around, joined, shares);
    photonShares[index] = shares;
    if (ofMap <= 0.0 || isOther) return;
    if (discarded > 0.0)
        ledgerAdd(kAccountDiscardedTriangle, flux.rgb * (ofMap * shares.quarter * discarded));
    // Where cells may be merged, their own pass lists them.
    if ((joined & 8u) != 0u && reconstruct_triangles_merge <= 0.0)
        list(index, kPatchJoined, kPatchesJoined);
    // A cell of its own is covered at once.
    if (joined == 0u && isPlain && count == 4u) {
        list(index, kPatchBeam, kPatchesOfBeams);
        return;
    }
    for (uint i = 0u; i < count; ++i)
        list(index, parts[i], parts[i] >= kPatchCrease ? kPatchesAtCreases : kPatchesOfBeams);
}
