// SPDX-License-Identifier: MIT
// The bounds of one level of the hierarchy from those of the level below it. One thread a node.
#include "include/thread.glsl"
#include "framework/transport/bvh.h"

uniform usamplerBuffer stillNodes;  // BvhNode, four texels each: whose children they are
uniform samplerBuffer bvhCorners;   // VertexData, two texels each
layout(std430) buffer BvhBounds {
    vec4 bvhBounds[];  // lower and upper corner of each node, m
};
layout(std430) writeonly buffer BvhNodes {
    BvhNode bvhNodes[];
};
uniform uint firstNode;
uniform uint nodeCount;

void main() {
    uint thread = threadNumber();
    if (thread >= nodeCount) return;
    uint number = firstNode + thread;
    uvec4 children = texelFetch(stillNodes, int(4u * number) + 1);
    vec3 lower[4] = vec3[4](vec3(3.4e38), vec3(3.4e38), vec3(3.4e38), vec3(3.4e38));
    vec3 upper[4] = vec3[4](vec3(-3.4e38), vec3(-3.4e38), vec3(-3.4e38), vec3(-3.4e38));
    vec3 lowest = vec3(3.4e38);
    vec3 highest = vec3(-3.4e38);
    for (int i = 0; i < 4; ++i) {
        uint child = children[i];
        if (child == kBvhNone) continue;
        if ((child & kBvhLeaf) == 0u) {
            lower[i] = bvhBounds[2u * child].xyz;
            upper[i] = bvhBounds[2u * child + 1u].xyz;
        } else {
            uint first = 3u * bvhLeafFirst(child);
            uint end = first + 3u * bvhLeafCount(child);
            for (uint corner = first; corner < end; ++corner) {
                vec3 position = texelFetch(bvhCorners, int(2u * corner)).xyz;
                lower[i] = min(lower[i], position);
                upper[i] = max(upper[i], position);
            }
        }
        lowest = min(lowest, lower[i]);
        highest = max(highest, upper[i]);
    }
    bvhBounds[2u * number] = vec4(lowest, 0.0);
    bvhBounds[2u * number + 1u] = vec4(highest, 0.0);
    bvhNodes[number] = bvhNodeOf(children, lower, upper);
}
