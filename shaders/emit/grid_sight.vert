// SPDX-License-Identifier: MIT
// The scene as a light sees it, and of which triangle each fragment is; `instances` are the light's.
#include "include/surfaces/scene_vertex.glsl"

flat out uint object;
uniform mat4 projection;
uniform vec2 sightSize;  // px, of the light's whole view

// What devices place vertices by, px.
const float kSnap = 1.0 / 256.0;

void main() {
    object = vertexObject;
    vec4 clip = projection * (instances[vertexObject].modelToView * vec4(vertexPosition, 1.0));
    // Snapped here, as the device would: in whichever rows of the view are drawn, its vertices are
    // the same, and so is the triangle that a cell's middle falls on.
    if (clip.w > 0.0) {
        vec2 scale = 0.5 * sightSize / kSnap;
        clip.xy = round(clip.xy / clip.w * scale) / scale * clip.w;
    }
    gl_Position = clip;
}
