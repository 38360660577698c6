// SPDX-License-Identifier: MIT
// Photons of four neighbouring cells, and where they arrive.
#include "reconstruct/triangles_arrival.glsl"

layout(std430) readonly buffer CellPhotons {
    uint cellPhotons[];
};

// The photon that has taken the same path, of the cell that lies so many next to this photon's;
// index + 1 in the list, 0 where there is none. It has this one's number nearly always: where it has
// not, the room for branches was shared out otherwise.
uint neighbourAt(PhotonOrigin origin, ivec2 neighbourOffset) {
    uint numbers = 1u << cellSplits;
    for (uint i = 0u; i < numbers; ++i) {
        uint number = ((origin.branch & 0xffu) + i) & (numbers - 1u);
        uint place = cellPlaceOf(origin, neighbourOffset, number);
        if (place == kNoCell) return 0u;
        uint found = cellPhotons[place];
        if (found > 0u && originAt(ivec2(photonTexel(photons, found - 1u))).path == origin.path)
            return found;
    }
    return 0u;
}

// By the corner: right, up: bits.
struct ArrivalsAround {
    Arrival corners[4];
};

// The photons at the corners of the quadrilateral with this photon at its corner `own`, index + 1 in
// the list; false where one is missing.
bool photonsAround(PhotonOrigin origin, uint own, out uint found[4]) {
    ivec2 first = -ivec2(own & 1u, own >> 1u);
    bool isWhole = true;
    for (uint i = 0u; i < 4u; ++i) {
        found[i] = neighbourAt(origin, first + ivec2(i & 1u, i >> 1u));
        isWhole = isWhole && found[i] > 0u;
    }
    return isWhole;
}

ArrivalsAround arrivalsOf(uint found[4]) {
    ArrivalsAround around;
    for (uint i = 0u; i < 4u; ++i)
        around.corners[i] = arrivalOf(ivec2(photonTexel(photons, found[i] - 1u)));
    return around;
}

vec2 stepBetween(uint from, uint to) {
    return vec2(to & 1u, to >> 1u) - vec2(from & 1u, from >> 1u);
}

bool areTogether(ArrivalsAround around, uint a, uint b) {
    return areNeighbours(around.corners[a], around.corners[b], stepBetween(a, b));
}
