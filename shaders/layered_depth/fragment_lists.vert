// SPDX-License-Identifier: MIT
// The scene as the eye sees it (raster_views/eye.vert), with the number of each object's first triangle.
#include "include/surfaces/scene_vertex.glsl"

invariant gl_Position;
uniform mat4 projection;

flat out uint firstTriangle;

void main() {
    gl_Position = projection * vec4(transformVertex(), 1.0);
    firstTriangle = instances[vertexObject].material.y;
}
