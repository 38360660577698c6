// SPDX-License-Identifier: MIT
// interactAt for a list of cases: direction and index before, normal and index after.
#include "include/thread.glsl"
#include "include/surfaces/fresnel.glsl"

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
    vec4 a = inputs[2 * i];
    vec4 b = inputs[2 * i + 1];
    Interface interaction = interactAt(a.xyz, b.xyz, a.w, b.w);
    outputs[2 * i] = vec4(interaction.refracted, interaction.reflectance);
    outputs[2 * i + 1] = vec4(interaction.reflected, 0.0);
}
