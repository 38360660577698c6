// SPDX-License-Identifier: MIT
// The scene as the eye sees it.
#include "include/surfaces/scene_vertex.glsl"

invariant gl_Position;
uniform mat4 projection;

void main() {
    gl_Position = projection * vec4(transformVertex(), 1.0);
}
