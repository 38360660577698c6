// SPDX-License-Identifier: MIT
// A fragment a photon of a list: a rectangle over the rows that hold it. A strip of four vertices.
#include "include/photons/photons.glsl"

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    uint rows = (photons.count + photons.rowLength - 1u) / photons.rowLength;
    corner.y *= float(rows) / float(textureSize(photonPosition, 0).y);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
