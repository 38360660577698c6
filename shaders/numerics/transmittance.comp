// SPDX-License-Identifier: MIT
// mediumTransmittance for a list of cases: medium, metres.
#include "include/thread.glsl"
#include "include/surfaces/surface_data.glsl"

layout(std430) readonly buffer Inputs {
    vec4 inputs[];
};
layout(std430) writeonly buffer Outputs {
    vec4 outputs[];
};
uniform int caseCount;

void main() {
    int i = int(threadNumber());
    if (i >= caseCount) return;
    outputs[i] = vec4(mediumTransmittance(uint(inputs[i].x), inputs[i].y), 0.0);
}
