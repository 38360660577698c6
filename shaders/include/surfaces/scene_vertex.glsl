// SPDX-License-Identifier: MIT
// The vertices of the scene; attributes as render/gpu_scene.cpp lays them out.
#include "framework/transport/types.h"

layout(location = 0) in vec3 vertexPosition;
layout(location = 1) in vec3 vertexNormal;
layout(location = 2) in float vertexU;
layout(location = 3) in float vertexV;
layout(location = 4) in uint vertexObject;

layout(std430) readonly buffer Instances {
    InstanceData instances[];
};

out vec3 positionVs;
out vec3 normalVs;
out vec2 uv;
flat out uint material;

// Fills the outputs in the view that `instances` belongs to; gives the view-space position.
vec3 transformVertex() {
    InstanceData instance = instances[vertexObject];
    positionVs = (instance.modelToView * vec4(vertexPosition, 1.0)).xyz;
    normalVs = mat3(instance.normalToView) * vertexNormal;
    uv = vec2(vertexU, vertexV);
    material = instance.material.x;
    return positionVs;
}
