// SPDX-License-Identifier: MIT
// The triangles that a light sees, and where its rays meet them.
#include "include/surfaces/point_on_triangle.glsl"
#include "include/surfaces/scene_triangle.glsl"

layout(std430) readonly buffer Instances {
    InstanceData instances[];  // in the eye's view
};
uniform mat4 lightFromEye;  // from the eye's view space to the light's

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
