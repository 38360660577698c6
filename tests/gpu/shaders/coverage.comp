// SPDX-License-Identifier: MIT
// coverageOf for a list of cases: two corners; the third one and the pixel's lower left corner.
// Out: what of the pixel is covered, and the triangle that was taken.
#include "framework/transport/coverage.h"

layout(local_size_x = 64) in;
layout(std430) readonly buffer Inputs {
    vec4 inputs[];
};
layout(std430) writeonly buffer Outputs {
    vec4 outputs[];
};
uniform int caseCount;

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= caseCount) return;
    vec4 ab = inputs[2 * i];
    vec4 c = inputs[2 * i + 1];
    ScreenTriangle triangle = triangleOf(ab.xy, ab.zw, c.xy);
    outputs[3 * i] = vec4(coverageOf(triangle, c.zw, 1.0), triangle.area, 0.0, 0.0);
    outputs[3 * i + 1] = vec4(triangle.a, triangle.b);
    outputs[3 * i + 2] = vec4(triangle.c, 0.0, 0.0);
}
