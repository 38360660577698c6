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
