// SPDX-License-Identifier: MIT
// Line source `geometry`: makes each photon's line from one representative (K06, section 6, future
// work).
#include "trace/lines.glsl"

layout(points) in;
layout(line_strip, max_vertices = 2) out;

flat in int row[];

void main() {
    if (!placeLineEnd(row[0], false)) return;
    EmitVertex();
    placeLineEnd(row[0], true);
    EmitVertex();
    EndPrimitive();
}
