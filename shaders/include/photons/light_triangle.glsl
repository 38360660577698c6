// SPDX-License-Identifier: MIT
// The triangles that a light sees, and where its rays meet them.
#include "include/surfaces/normal_map.glsl"
#include "include/surfaces/scene_triangle.glsl"

layout(std430) readonly buffer Instances {
    InstanceData instances[];  // in the eye's view
};
uniform mat4 lightFromEye;  // from the eye's view space to the light's

// A point of a triangle, in the eye's view.
struct PointOnTriangle {
    vec3 position;   // m
    vec3 normal;     // interpolated, of any length
    vec3 geometric;  // unit, to the side that the triangle's winding calls the outside; 0: has none
    mat2x3 places;   // along two sides, m
    mat2x3 turns;    // of `normal`
};

float crossed(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// Of a triangle's corners, where the light's ray hits it; they add up to 1. `place`: where that is
// across its view, m, or the tangents of its angles.
vec3 weightsOnRay(vec3 corners[3], vec2 place, bool isParallel) {
    vec3 depths = -vec3(corners[0].z, corners[1].z, corners[2].z);
    vec3 weights;
    if (!isParallel && min(depths.x, min(depths.y, depths.z)) <= 0.0) {
        // It goes on behind the light.
        vec3 ray = vec3(place, -1.0);
        weights = vec3(dot(ray, cross(corners[1], corners[2])),
                       dot(ray, cross(corners[2], corners[0])),
                       dot(ray, cross(corners[0], corners[1])));
    } else {
        vec3 nearness = isParallel ? vec3(1.0) : 1.0 / depths;
        vec2 a = corners[0].xy * nearness.x - place;
        vec2 b = corners[1].xy * nearness.y - place;
        vec2 c = corners[2].xy * nearness.z - place;
        weights = vec3(crossed(b, c), crossed(c, a), crossed(a, b)) * nearness;
    }
    // A triangle that lies in the light's direction is hit anywhere along it.
    float sum = weights.x + weights.y + weights.z;
    float minimum = 1e-6 * (abs(weights.x) + abs(weights.y) + abs(weights.z));
    return abs(sum) > minimum ? weights / sum : vec3(1.0 / 3.0);
}

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

// Where the light's ray hits the triangle. `place`: as in weightsOnRay. `minimum`: of its weights, less
// than 0 where the ray passes the triangle by.
PointOnTriangle pointOnTriangle(uvec2 seen, vec2 place, bool isParallel, out float minimum) {
    uint object = seen.x - 1u;
    vec3 positions[3];
    vec3 normals[3];
    vec3 ofLight[3];  // in its view
    vec2 uvs[3];
    for (uint i = 0u; i < 3u; ++i) {
        VertexData corner = cornerOfTriangle(instances[object], seen.y, i);
        positions[i] = (instances[object].modelToView * vec4(corner.position, 1.0)).xyz;
        normals[i] = mat3(instances[object].normalToView) * corner.normal;
        uvs[i] = vec2(corner.u, corner.v);
        ofLight[i] = (lightFromEye * vec4(positions[i], 1.0)).xyz;
    }
    vec3 weights = weightsOnRay(ofLight, place, isParallel);
    minimum = min(weights.x, min(weights.y, weights.z));
    vec3 area = cross(positions[1] - positions[0], positions[2] - positions[0]);
    float size = length(area);
    PointOnTriangle point = PointOnTriangle(
        weights.x * positions[0] + weights.y * positions[1] + weights.z * positions[2],
        weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2],
        size > 0.0 ? area / size : vec3(0.0),
        mat2x3(positions[1] - positions[0], positions[2] - positions[0]),
        mat2x3(normals[1] - normals[0], normals[2] - normals[0]));
#ifdef NORMAL_MAPS
    mapNormal(point, instances[object].material.x, uvs, weights);
#endif
    return point;
}
PointOnTriangle pointOnTriangle(uvec2 seen, vec2 place, bool isParallel) {
    float minimum;
    return pointOnTriangle(seen, place, isParallel, minimum);
}
