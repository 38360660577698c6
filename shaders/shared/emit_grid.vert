// SPDX-License-Identifier: MIT
// The scene as a light sees it; positions and normals go on in the eye's view space.
#include "include/scene_vertex.glsl"

layout(std430) readonly buffer LightInstances {
    InstanceData lightInstances[];
};
uniform mat4 projection;

void main() {
    transformVertex();
    vec4 positionLs = lightInstances[vertexObject].modelToView * vec4(vertexPosition, 1.0);
    gl_Position = projection * vec4(positionLs.xyz, 1.0);
}
