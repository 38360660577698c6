// SPDX-License-Identifier: MIT
// Unit vectors as two numbers in [-1, 1]: the octahedron |x| + |y| + |z| = 1, its lower half folded
// out. As exact as the floats that hold them.
vec2 signOf(vec2 v) {
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec2 packUnitVector(vec3 unit) {
    vec3 n = unit / (abs(unit.x) + abs(unit.y) + abs(unit.z));
    return n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * signOf(n.xy);
}

vec3 unpackUnitVector(vec2 folded) {
    vec3 n = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * signOf(n.xy);
    return normalize(n);
}

// The same in one number, 12 bits for each of the two, which a float holds exactly; off by 5e-4 rad at
// most.
const float kUnitVectorSteps = 4095.0;

float quantizedUnitVector(vec3 unit) {
    vec2 steps = round((packUnitVector(unit) * 0.5 + 0.5) * kUnitVectorSteps);
    return steps.x + 4096.0 * steps.y;
}

vec3 unitVectorOfQuantized(float number) {
    float y = floor(number / 4096.0);
    return unpackUnitVector(vec2(number - 4096.0 * y, y) * (2.0 / kUnitVectorSteps) - 1.0);
}
