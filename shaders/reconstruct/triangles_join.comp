// SPDX-License-Identifier: MIT
// reconstruct.triangles: whether a photon and its neighbours to the right, above and between are
// joined: light of one path that arrives on one surface, each where the others' beams say, so that
// what lies between them arrives in between. One thread a photon.
#include "reconstruct/triangles_neighbours.glsl"

layout(std430) writeonly buffer CellJoins {
    uint cellJoins[];  // by the photon at the lower left: 1 joined
};

bool isJoined(uint index) {
    PhotonOrigin origin = originAt(ivec2(photonTexel(photons, index)));
    uint found[4];
    if (!photonsAround(origin, 0u, found) || found[0] != index + 1u) return false;
    ArrivalsAround around = arrivalsOf(found);
#ifdef MANY_VIEWS
    // By the angle from the first, of which any two are no farther apart than twice.
    float texel = 2.0 * view.sizePixels.z;
    float widest = 0.5 * float(reconstruct_triangles_maximum) * texel;
    vec3 middle = normalize(around.corners[0].position);
    for (uint i = 1u; i < 4u; ++i) {
        vec3 off = normalize(around.corners[i].position) - middle;
        if (!(length(off) <= 2.0 * sin(0.5 * widest))) return false;
    }
#else
    vec2 minimum = vec2(1e30);
    vec2 maximum = vec2(-1e30);
    for (uint i = 0u; i < 4u; ++i) {
        vec3 position = around.corners[i].position;
        if (!(-position.z > view.frustum.z)) return false;
        vec2 pixel = pixelOf(position);
        minimum = min(minimum, pixel);
        maximum = max(maximum, pixel);
    }
    vec2 size = maximum - minimum;
    if (!(max(size.x, size.y) <= float(reconstruct_triangles_maximum))) return false;
#endif
    return areTogether(around, 0u, 1u) && areTogether(around, 2u, 3u) &&
           areTogether(around, 0u, 2u) && areTogether(around, 1u, 3u);
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    cellJoins[index] = isJoined(index) ? 1u : 0u;
}
