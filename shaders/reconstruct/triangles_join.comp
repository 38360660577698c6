// SPDX-License-Identifier: MIT
// reconstruct.triangles: whether a photon and its neighbours to the right, above and between are
// joined: light of one path that arrives on one surface, each where the others' beams say, so that
// what lies between them arrives in between. One thread an arrival.
#include "include/photons/arriving.glsl"
#include "reconstruct/triangles_arrivals.glsl"
#include "reconstruct/triangles_neighbours.glsl"

layout(std430) writeonly buffer CellJoins {
    uint cellJoins[];  // by the photon at the lower left: 1 joined
};

#ifdef MANY_VIEWS
// Whether four photons arrive at no more than so many texels from one to the other, seen from
// `point`, eye view space: by the angle from the first, of which any two are no farther apart than
// twice.
bool areNarrowFrom(vec3 point, uint found[4]) {
    float texel = 2.0 * view.sizePixels.z;
    float widest = 0.5 * float(reconstruct_triangles_maximum) * texel;
    vec3 middle = vec3(0.0);
    for (uint i = 0u; i < 4u; ++i) {
        vec3 position = texelFetch(hitPosition, ivec2(photonTexel(photons, found[i] - 1u)), 0).xyz;
        vec3 direction = normalize(position - point);
        if (i == 0u) middle = direction;
        if (!(length(direction - middle) <= 2.0 * sin(0.5 * widest))) return false;
    }
    return true;
}

// Of a generator that has several reference points, whose maps share its light out, seen from each
// of them: what one map joins the others do.
bool areNarrow(uint found[4]) {
#ifdef ONE_GENERATOR
    mat3 toEye = transpose(mat3(generators.eyeToWorld));
    float whole = generators.centers[generatorOfMap].w;
    for (int i = 0; i < int(generators.count.x); ++i) {
        if (generators.centers[i].w == whole &&
            !areNarrowFrom(toEye * generators.references[i].xyz, found))
            return false;
    }
    return true;
#else
    return areNarrowFrom(-(transpose(mat3(view.fromEye)) * view.fromEye[3].xyz), found);
#endif
}
#endif

bool isJoined(uint index) {
    PhotonOrigin origin = originAt(ivec2(photonTexel(photons, index)));
    uint found[4];
    if (!photonsAround(origin, 0u, found) || found[0] != index + 1u) return false;
    ArrivalsAround around = arrivalsOf(found);
    // Others stand for what lies between them.
    if (isLeftOut(around.corners[0], 3u)) return false;
#ifdef MANY_VIEWS
    if (!areNarrow(found)) return false;
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
    uint index;
    if (arrivalOfThread(index)) cellJoins[index] = isJoined(index) ? 1u : 0u;
}
