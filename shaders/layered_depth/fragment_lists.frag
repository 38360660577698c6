// SPDX-License-Identifier: MIT
// Adds a fragment to the list of its pixel (Yang et al. 2010) and to its count: what peel.frag
// writes, as bits, and the number of its triangle.
#include "framework/transport/octahedral.h"
#include "include/surfaces/fragment_normal.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface.glsl"
#include "layered_depth/fragment_lists.glsl"

layout(location = 0) out float count;

flat in uint firstTriangle;
layout(r32ui) uniform uimage2D heads;
layout(std430) writeonly buffer FragmentDepths {
    uvec4 fragmentDepths[];
};
layout(std430) writeonly buffer FragmentSurfaces {
    uvec4 fragmentSurfaces[];
};
layout(std430) writeonly buffer FragmentTriangles {
    uint fragmentTriangles[];
};

void main() {
    vec3 geometric = geometricNormal(positionVs, towardsViewer(positionVs));
    vec3 shading = fragmentNormal(geometric);
    count = 1.0;
    uint place = atomicAdd(fragmentCounts[face], 1u);
    if (place >= capacity) return;
    uint next = imageAtomicExchange(heads, ivec2(gl_FragCoord.xy), place + 1u);
    fragmentDepths[place] =
        uvec4(floatBitsToUint(vec3(-positionVs.z, packUnitVector(geometric))), next);
    fragmentSurfaces[place] = uvec4(floatBitsToUint(shading), material);
    fragmentTriangles[place] = firstTriangle + uint(gl_PrimitiveID);
}
