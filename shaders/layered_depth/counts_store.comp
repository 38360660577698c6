// SPDX-License-Identifier: MIT
// The last texel of the reduce becomes the statistics.
#include "framework/transport/types.h"

layout(local_size_x = 1) in;

uniform sampler2D reduced;
layout(std430) writeonly buffer Statistics {
    LayerStatistics statistics;
};

void main() {
    uvec4 all = uvec4(texelFetch(reduced, ivec2(0), 0));
    statistics = LayerStatistics(all.x, all.y, all.z, all.w);
}
