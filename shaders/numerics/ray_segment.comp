// SPDX-License-Identifier: MIT
// clipRay for a list of rays, and the depth and parameter at an index along each.
#include "include/thread.glsl"
#include "include/views/ray_segment.glsl"

layout(std430) readonly buffer Inputs {
    vec4 inputs[];  // origin, index; direction, count
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
    RaySegment segment = clipRay(a.xyz, b.xyz);
    outputs[3 * i] = vec4(segment.visible ? 1.0 : 0.0, float(segment.cause), 0.0, 0.0);
    outputs[3 * i + 1] = vec4(0.0);
    outputs[3 * i + 2] = vec4(0.0);
    if (!segment.visible) return;
    outputs[3 * i].zw = vec2(segment.nearT, segment.farT);
    outputs[3 * i + 1] = vec4(segment.nearPixel, segment.farPixel);
    outputs[3 * i + 2] = vec4(depthAtIndex(segment, a.w, b.w), parameterAtIndex(segment, a.w, b.w),
                              float(stepCount(segment, 4, 16384)), 0.0);
}
