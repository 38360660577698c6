// SPDX-License-Identifier: MIT
// Which caustic generator a photon has left: the one whose box its place is in, or nearest to.
#include "techniques/generators/generators_data.h"

layout(std140) uniform Generators {
    GeneratorsData generators;
};

// How far outside of a generator's box a place is, m: x; y: how far from its middle, in boxes.
vec2 awayFrom(int generator, vec3 positionVs) {
    vec3 place = mat3(generators.eyeToWorld) * positionVs;
    vec3 offset = abs(place - generators.centers[generator].xyz);
    vec3 halfExtent = generators.halfExtents[generator].xyz;
    vec3 shares = offset / max(halfExtent, vec3(1e-20));
    // A place on the surface may be rounded to the outside.
    float slack = 1e-4 * (length(halfExtent) + length(positionVs));
    return vec2(max(length(max(offset - halfExtent, 0.0)) - slack, 0.0),
                max(shares.x, max(shares.y, shares.z)));
}

int generatorOf(vec3 positionVs) {
    int nearest = 0;
    vec2 minimum = vec2(3.0e38);
    for (int i = 0; i < int(generators.count.x); ++i) {
        vec2 away = awayFrom(i, positionVs);
        if (away.x > minimum.x || (away.x == minimum.x && away.y >= minimum.y)) continue;
        minimum = away;
        nearest = i;
    }
    return nearest;
}

// The share of light that leaves a place which goes to this generator's map: all of it to that of
// the one it has left, but of those that are parts of one, each with its own reference point, all
// that are near take some, so that no border is seen where one map ends and the next begins. The
// shares of all add up to 1.
float shareOfGenerator(vec3 positionVs, int generator) {
    int own = generatorOf(positionVs);
    float whole = generators.centers[own].w;
    if (generators.centers[generator].w != whole) return 0.0;
    float sum = 0.0;
    float share = 0.0;
    float nearest = awayFrom(own, positionVs).x;
    for (int i = 0; i < int(generators.count.x); ++i) {
        if (generators.centers[i].w != whole) continue;
        float beyond = awayFrom(i, positionVs).x - nearest;
        float weight = max(1.0 - beyond / max(generators.halfExtents[i].w, 1e-20), 0.0);
        sum += weight;
        if (i == generator) share = weight;
    }
    return share / sum;
}
