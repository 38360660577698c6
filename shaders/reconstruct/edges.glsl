// SPDX-License-Identifier: MIT
// reconstruct.edges: the pixels in which a surface ends (techniques/reconstruct/edge_samples.h).
#include "include/thread_list.glsl"
#include "include/views/continued_plane.glsl"

layout(std430) buffer EdgePixels {
    ThreadList edges;
    uint edgePixels[];  // x + 65536 y
};

uniform uint edgeCapacity;
