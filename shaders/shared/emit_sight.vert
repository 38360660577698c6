// SPDX-License-Identifier: MIT
// The scene as a light sees it, and of which triangle each fragment is; `instances` are the light's.
#include "include/scene_vertex.glsl"

flat out uint object;
uniform mat4 projection;

void main() {
    object = vertexObject;
    gl_Position = projection * (instances[vertexObject].modelToView * vec4(vertexPosition, 1.0));
}
