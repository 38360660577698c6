// SPDX-License-Identifier: MIT
// The triangles of the scene for shaders that draw nothing, as GpuScene::bindTriangles binds them.
#include "framework/transport/types.h"

layout(std430) readonly buffer SceneVertices {
    VertexData sceneVertices[];
};
layout(std430) readonly buffer HeightFieldVertices {
    VertexData heightFieldVertices[];
};
layout(std430) readonly buffer SceneIndices {
    uint sceneIndices[];
};

// A corner of an object's triangle, in the mesh's space; triangles count from the object's first.
VertexData cornerOfTriangle(InstanceData instance, uint triangle, uint corner) {
    uint index = sceneIndices[instance.material.z + 3u * triangle + corner];
    uint vertex = (instance.material.w >> 1u) + index;
    if ((instance.material.w & 1u) == 0u) return sceneVertices[vertex];
    return heightFieldVertices[vertex];
}
