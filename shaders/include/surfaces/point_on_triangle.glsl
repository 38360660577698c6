// SPDX-License-Identifier: MIT
// A point of a triangle, and what its material's normal map makes of the normal there.
#include "include/surfaces/normal_map.glsl"

// In any space of metres.
struct PointOnTriangle {
    vec3 position;   // m
    vec3 normal;     // interpolated, of any length
    vec3 geometric;  // unit, to the side that the triangle's winding calls the outside; 0: has none
    mat2x3 places;   // along two sides, m
    mat2x3 turns;    // of `normal`
};

#ifdef NORMAL_MAPS
// What a normal map makes of the point's normal, and of how that turns: by differences over a texel,
// since the map is linear between two.
void mapNormal(inout PointOnTriangle point, uint material, vec2 uvs[3], vec3 weights) {
    if (!hasNormalMap(material)) return;
    mat2 uvSides = mat2(uvs[1] - uvs[0], uvs[2] - uvs[0]);
    mat2x3 turns = point.turns;
    vec2 uv = weights.x * uvs[0] + weights.y * uvs[1] + weights.z * uvs[2];
    vec3 normal = point.normal;
    point.normal = mappedNormalAt(material, shadingNormal(normal, point.geometric), point.places,
                                  uvSides, uv);
    for (int side = 0; side < 2; ++side) {
        float texels = length(normalTexels(material, uvSides[side]));
        float reach = 0.5 / max(texels, 1.0);
        vec3 ends[2];
        for (int i = 0; i < 2; ++i) {
            float at = i == 0 ? -reach : reach;
            vec3 there = shadingNormal(normal + at * turns[side], point.geometric);
            ends[i] = mappedNormalAt(material, there, point.places, uvSides, uv + at * uvSides[side]);
        }
        point.turns[side] = (ends[1] - ends[0]) / (2.0 * reach);
    }
}
#endif
