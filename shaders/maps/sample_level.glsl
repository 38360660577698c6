// SPDX-License-Identifier: MIT
// A level of a map at a texel of the map's own resolution, bilinear.
#include "maps/levels.glsl"

// What the texel gets of one of a level that is 4^level times as large. `first`: set of level 0.
vec3 sampleLevel(ivec2 texel, int level, int first) {
    if (level == 0) return sumAt(texel, first);
    vec2 at = (vec2(texel) + 0.5) / float(1 << level) - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 there = clamp(corner + step, ivec2(0), sizeOfLevel(level) - 1);
        vec2 axis = mix(1.0 - f, f, vec2(step));
        sum += axis.x * axis.y * sumAt(placeOfLevel(level) + there, first + setOfLevel(level));
    }
    return sum / float(1 << (2 * level));
}
