// SPDX-License-Identifier: MIT
// A point a cell that was taken, of the instances of an indirect draw, each of several vertices.
flat out uint cellIndex;

void main() {
    cellIndex = gl_VertexID == 0 ? uint(gl_InstanceID) : 0xffffffffu;
    gl_Position = vec4(0.0);
}
