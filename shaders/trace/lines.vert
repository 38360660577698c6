// SPDX-License-Identifier: MIT
// Line source `vertex`: two vertices a photon, told from their number (K06, section 2.1).
#include "trace/lines.glsl"

void main() {
    placeLineEnd(gl_VertexID / 2, (gl_VertexID & 1) == 1);
}
