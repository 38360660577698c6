// SPDX-License-Identifier: MIT
// One end of the horizontal line of a photon (K06, section 2.1, Fig. 4): from the left edge of the
// photon's row, one fragment a step. The line is drawn half a texel longer at both ends and the
// fragments are told apart by their own position, so that the result does not depend on how a
// device rasterises the ends of lines (hard case 6).
#include "include/photons/photons.glsl"
#include "tracing/tile_steps.glsl"
#include "trace/lines_row_extent.glsl"

uniform int firstPhoton;
uniform ivec2 rowsSize;
uniform int maxSteps;

flat out vec4 endPixels;
flat out vec4 ends;  // 1/z and t of both ends
flat out vec3 rayOrigin;
flat out vec3 rayDirection;
flat out int steps;
flat out ivec2 asked;  // of them: the first, which is the row's first texel, and the end
flat out int photonIndex;

// Sets gl_Position and the outputs; whether there is a line.
bool placeLineEnd(int row, bool isEnd) {
    photonIndex = firstPhoton + row;
    steps = 0;
    asked = ivec2(0);
    gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);  // outside: a line of no fragments
    if (uint(photonIndex) >= photons.count) return false;
    ivec2 texel = ivec2(photonTexel(photons, uint(photonIndex)));
    vec4 direction = texelFetch(photonDirection, texel, 0);
    if (uint(direction.w) != kFateInFlight) return false;
    rayOrigin = texelFetch(photonPosition, texel, 0).xyz;
    rayDirection = direction.xyz;
    RaySegment segment = clipRay(rayOrigin, rayDirection);
    if (!segment.visible) return false;
    steps = stepCount(segment, trace_lines_minimum, maxSteps);
    StepRange range = stepsToAsk(segment, steps);
    if (range.first >= range.end) return false;
    asked = ivec2(range.first, range.end);
    int count = range.end - range.first;
    if (isEnd) atomicMax(rowExtents[batch], uint(count));
    endPixels = vec4(segment.nearPixel, segment.farPixel);
    ends = vec4(segment.nearNearness, segment.farNearness, segment.nearT, segment.farT);
    float column = isEnd ? float(count) + 0.5 : -0.5;
    vec2 position = vec2(column, float(row) + 0.5) / vec2(rowsSize);
    gl_Position = vec4(position * 2.0 - 1.0, 0.0, 1.0);
    return true;
}
