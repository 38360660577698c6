// SPDX-License-Identifier: MIT
// Line source `geometry`: one point a photon, which the geometry shader makes a line of.
flat out int row;

void main() {
    row = gl_VertexID;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
