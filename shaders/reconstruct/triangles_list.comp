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

// Where in a neighbourhood a quadrilateral has its lower left corner, by its quarter; and from there
// its corners, by theirs: right, up: bits.
uint placeAround(uint corner) { return (corner & 1u) + 3u * (corner >> 1u); }

// The areas of the triangles that the photon is a corner of, in cells that are joined: bits by the
// corner of its cell (U08, section 5: in a pass of its own, once a photon).
void addAreas(Neighbourhood around, uint joined, inout VertexShares shares) {
    for (uint i = 0u; i < 4u; ++i) {
        if ((joined & (1u << i)) == 0u) continue;
        vec3 corners[4];  // around the cell, from its lower left
        for (uint k = 0u; k < 4u; ++k) {
            uint corner = around.photons[placeAround(i) + placeAround(k ^ (k >> 1u))];
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

// Of all of a neighbourhood, the photon's own where there is none.
struct Landings {
    Landing all[9];
};
Landings landingsOf(Neighbourhood around, uint own) {
    Landings landings;
    for (int i = 0; i < 9; ++i)
        landings.all[i] = landingOf(around.photons[i] > 0u ? around.photons[i] - 1u : own);
    return landings;
}

// Whether the light of four neighbours comes down on more than one surface.
bool isAtCrease(Neighbourhood around, Landings landings, uint quarter) {
    Landing first = landings.all[placeAround(quarter)];
    bool isOne = true;
    bool isWhole = true;
    for (uint i = 0u; i < 4u; ++i) {
        uint at = placeAround(quarter) + placeAround(i);
        Landing landing = landings.all[at];
        isWhole = isWhole && around.photons[at] > 0u && landing.path == first.path;
        isOne = isOne && landing.material == first.material && dot(landing.normal, first.normal) >= 0.5;
    }
    return isWhole && !isOne;
}

uint kindOf(uint part) {
    if (part == kPatchJoined) return kPatchesJoined;
    return part >= kPatchCrease && part < kPatchCrease + 4u ? kPatchesAtCreases : kPatchesOfBeams;
}

// `parts`: their bits.
void list(uint index, uint parts) {
    do {
        if (parts == 0u) break;
        uint part = uint(findLSB(parts));
        uint kind = kindOf(part);
        uint number = atomicAdd(patches[kind].count, 1u);
        patchList[patchPlace(kind, number, uint(listCapacity))] = index * kPatchParts + part;
        parts &= parts - 1u;
    } while (parts != 0u);
}

// Of quarters that are whole two next to each other are one half, as they would be together.
uint withHalves(uint parts, uint wholeQuarters) {
    for (uint i = 0u; i < 4u; ++i) {
        uint quarters = quartersOfHalf(i);
        if ((wholeQuarters & quarters) != quarters) continue;
        wholeQuarters &= ~quarters;
        parts = (parts & ~(quarters << kPatchQuarter)) | 1u << (kPatchHalf + i);
    }
    return parts;
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
    Landings landings = landingsOf(around, index);
    Arrival own = arrivalOf(texel);
    uint joined = 0u;  // bits by the corner
    uint parts = 0u;
    uint wholeQuarters = 0u;
    float whole = 0.0;
    float discarded = 0.0;
    bool isPlain = own.extent == uvec2(0u);
    for (uint i = 0u; i < 4u; ++i) {
        uint lowerLeft = around.photons[placeAround(i)];
        if (lowerLeft > 0u && cellJoins[lowerLeft - 1u] == 1u) {
            joined |= 1u << i;
            whole += 1.0;
            continue;
        }
        bool isCrease = !isLeftOut(own, i) && isAtCrease(around, landings, i);
        float area = areaOf(cornersOf(own, i));
        whole += area;
        bool isListed = isCrease || area > 0.0;
        if (reconstruct_triangles_unjoined == reconstruct_triangles_unjoined_discard) {
            discarded += area;
        } else if (isListed) {
            parts |= 1u << ((isCrease ? kPatchCrease : kPatchQuarter) + i);
            if (!isCrease && area > 0.9999) wholeQuarters |= 1u << i;
        }
    }
    // What the parts that light can come through take is all of its flux.
    VertexShares shares = VertexShares(whole > 0.0 ? 1.0 / whole : 0.0, 0.0, 0.0,
                                       float(bitCount(joined)));
    if (reconstruct_triangles_shading == reconstruct_triangles_shading_vertices)
        addAreas(around, joined, shares);
    photonShares[index] = shares;
    if (ofMap <= 0.0 || isOther) return;
    if (discarded > 0.0)
        ledgerAdd(kAccountDiscardedTriangle, flux.rgb * (ofMap * shares.quarter * discarded));
    if (isPlain) {
        // A cell of its own is covered at once.
        const uint kAllQuarters = 0xfu << kPatchQuarter;
        parts = parts == kAllQuarters ? 1u << kPatchBeam : withHalves(parts, wholeQuarters);
    }
    // Where cells may be merged, their own pass lists them.
    if ((joined & 8u) != 0u && reconstruct_triangles_merge <= 0.0) parts |= 1u << kPatchJoined;
    list(index, parts);
}
