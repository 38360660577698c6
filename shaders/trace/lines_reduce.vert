// SPDX-License-Identifier: MIT
// A rectangle over the columns that one halving of the rows leaves in use.
#include "trace/lines_row_extent.glsl"

uniform ivec2 targetSize;
uniform int halvings;  // done once this one is

flat out int sourceWidth;

void main() {
    int extent = int(rowExtents[batch]);
    int step = 1 << (halvings - 1);
    sourceWidth = (extent + step - 1) / step;
    float right = float((sourceWidth + 1) / 2) / float(targetSize.x);
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(vec2(corner.x * right, corner.y) * 2.0 - 1.0, 0.0, 1.0);
}
