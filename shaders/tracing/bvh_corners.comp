// SPDX-License-Identifier: MIT
// The triangles of the hierarchy that height fields have, where they are in this frame, from the
// vertices that are made anew; the others stay as they were. One thread a triangle.
#include "include/surfaces/scene_triangle.glsl"
#include "include/thread.glsl"
#include "framework/transport/bvh.h"

layout(std430) readonly buffer BvhSources {
    BvhSource bvhSources[];
};
layout(std430) readonly buffer LocalInstances {
    InstanceData localInstances[];
};
layout(std430) writeonly buffer BvhCorners {
    VertexData bvhCorners[];
};
uniform uint triangleCount;

void main() {
    uint triangle = threadNumber();
    if (triangle >= triangleCount) return;
    BvhSource source = bvhSources[triangle];
    if (source.isMoving == 0u) return;
    InstanceData instance = localInstances[source.object];
    for (uint i = 0u; i < 3u; ++i) {
        VertexData corner = cornerOfTriangle(instance, source.triangle, i);
        corner.position = (instance.modelToView * vec4(corner.position, 1.0)).xyz;
        corner.normal = mat3(instance.normalToView) * corner.normal;
        bvhCorners[3u * triangle + i] = corner;
    }
}
