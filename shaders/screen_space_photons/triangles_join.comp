// SPDX-License-Identifier: MIT
// reconstruct.triangles: whether a photon and its neighbours to the right, above and between are
// joined: light of one path that arrives on one surface, each where the others' beams say, so that
// what lies between them arrives in between. One thread a photon.
#include "screen_space_photons/arrival.glsl"

layout(std430) readonly buffer CellPhotons {
    uint cellPhotons[];
};
layout(std430) writeonly buffer CellJoins {
    uint cellJoins[];  // by the photon at the lower left: 1 joined
};

bool belongAlong(Arrival a, Arrival b, int axis) {
    return belongTogether(a, b, vec2(axis == 0, axis == 1));
}

bool isInFront(vec3 position) {
    return -position.z > view.frustum.z;
}

bool isJoined(uint index) {
    ivec2 texel = ivec2(photonTexel(photons, index));
    PhotonOrigin origin = originAt(texel);
    uint own = cellPlace(origin, ivec2(0));
    uvec3 places = uvec3(cellPlace(origin, ivec2(1, 0)), cellPlace(origin, ivec2(1, 1)),
                         cellPlace(origin, ivec2(0, 1)));
    if (own == kNoCell || cellPhotons[own] != index + 1u) return false;
    if (any(equal(places, uvec3(kNoCell)))) return false;
    uvec3 found = uvec3(cellPhotons[places.x], cellPhotons[places.y], cellPhotons[places.z]);
    if (any(equal(found, uvec3(0u)))) return false;
    Arrival a = arrivalOf(texel);
    Arrival b = arrivalOf(ivec2(photonTexel(photons, found.x - 1u)));
    Arrival c = arrivalOf(ivec2(photonTexel(photons, found.y - 1u)));
    Arrival d = arrivalOf(ivec2(photonTexel(photons, found.z - 1u)));
    if (!(isInFront(a.position) && isInFront(b.position) && isInFront(c.position) &&
          isInFront(d.position))) {
        return false;
    }
    vec2 pa = pixelOf(a.position);
    vec2 pb = pixelOf(b.position);
    vec2 pc = pixelOf(c.position);
    vec2 pd = pixelOf(d.position);
    vec2 size = max(max(pa, pb), max(pc, pd)) - min(min(pa, pb), min(pc, pd));
    if (!(max(size.x, size.y) <= float(reconstruct_triangles_maximum))) return false;
    return belongAlong(a, b, 0) && belongAlong(d, c, 0) && belongAlong(a, d, 1) &&
           belongAlong(b, c, 1);
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    cellJoins[index] = isJoined(index) ? 1u : 0u;
}
