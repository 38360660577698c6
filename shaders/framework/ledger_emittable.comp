// SPDX-License-Identifier: MIT
// Adds up what a light sends onto the specular surfaces that it sees first. A thread a square of
// texels.
#include "include/photons/ledger_of_group.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D emittable;  // W, all channels together
uniform int side;             // texels of a square

void threadMain() {
    ivec2 first = side * ivec2(gl_GlobalInvocationID.xy);
    ivec2 end = min(first + side, textureSize(emittable, 0));
    float watts = 0.0;
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) watts += texelFetch(emittable, ivec2(x, y), 0).x;
    }
    if (watts > 0.0) ledgerAdd(kAccountEmittable, vec3(watts, 0.0, 0.0));
}
