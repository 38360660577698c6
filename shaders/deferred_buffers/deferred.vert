// SPDX-License-Identifier: MIT
// The scene as a view sees it, for fronts and backs (WN09, section 3.1). ONCE: for deferred.geom.
#ifdef ONCE
#define positionVs vertexPositionVs
#define normalVs vertexNormalVs
#define uv vertexUv
#define material vertexMaterial
#define objectSeen vertexObjectSeen
#endif
#include "include/surfaces/scene_vertex.glsl"

flat out uint objectSeen;
uniform mat4 projection;
#ifndef ONCE
uniform int layer;
#endif

void main() {
    gl_Position = projection * vec4(transformVertex(), 1.0);
    objectSeen = vertexObject;
#ifndef ONCE
    // Of backs the farthest is kept.
    if (layer == 1) gl_Position.z = gl_Position.w - gl_Position.z;
#endif
}
