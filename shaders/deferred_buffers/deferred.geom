// SPDX-License-Identifier: MIT
// Parts a triangle to the first surfaces or to the backs of bodies, so that all is drawn once
// (WN09, section 3.1), from layer `firstLayer` on. BACKS_FIRST: the light may be within a body, and
// see its backs first.
#include "include/surfaces/surface_data.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 6) out;

in vec3 vertexPositionVs[];
in vec3 vertexNormalVs[];
in vec2 vertexUv[];
flat in uint vertexMaterial[];
flat in uint vertexObjectSeen[];

out vec3 positionVs;
out vec3 normalVs;
out vec2 uv;
flat out uint material;
flat out uint objectSeen;

uniform int firstLayer;

void emitTo(int layer) {
    for (int i = 0; i < 3; ++i) {
        positionVs = vertexPositionVs[i];
        normalVs = vertexNormalVs[i];
        uv = vertexUv[i];
        material = vertexMaterial[i];
        objectSeen = vertexObjectSeen[i];
        gl_Position = gl_in[i].gl_Position;
        // Of backs the farthest is kept.
        if (layer == 1) gl_Position.z = gl_Position.w - gl_Position.z;
        gl_Layer = firstLayer + layer;
        gl_PrimitiveID = gl_PrimitiveIDIn;
        EmitVertex();
    }
    EndPrimitive();
}

void main() {
    float turn = determinant(
        mat3(gl_in[0].gl_Position.xyw, gl_in[1].gl_Position.xyw, gl_in[2].gl_Position.xyw));
    uint which = vertexMaterial[0];
    bool isBack = turn < 0.0 && materialKind(which) == kMaterialDielectric && !isOpen(which);
#ifdef BACKS_FIRST
    emitTo(0);
#else
    if (!isBack) emitTo(0);
#endif
    if (isBack) emitTo(1);
}
