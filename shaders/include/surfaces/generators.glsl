// SPDX-License-Identifier: MIT
// Which caustic generator a photon has left: the one whose box its place is in, or nearest to.
#include "framework/transport/types.h"

layout(std140) uniform Generators {
    GeneratorsData generators;
};

int generatorOf(vec3 positionVs) {
    vec3 place = mat3(generators.eyeToWorld) * positionVs;
    int nearest = 0;
    vec2 minimum = vec2(3.0e38);  // how far outside of the box, m; how far from its middle, in boxes
    for (int i = 0; i < int(generators.count.x); ++i) {
        vec3 offset = abs(place - generators.centers[i].xyz);
        vec3 halfExtent = generators.halfExtents[i].xyz;
        vec3 shares = offset / max(halfExtent, vec3(1e-20));
        // A place on the surface may be rounded to the outside.
        float slack = 1e-4 * (length(halfExtent) + length(positionVs));
        vec2 away = vec2(max(length(max(offset - halfExtent, 0.0)) - slack, 0.0),
                         max(shares.x, max(shares.y, shares.z)));
        if (away.x > minimum.x || (away.x == minimum.x && away.y >= minimum.y)) continue;
        minimum = away;
        nearest = i;
    }
    return nearest;
}
