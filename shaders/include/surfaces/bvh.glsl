// SPDX-License-Identifier: MIT
// The first triangle on a ray through the hierarchy of the scene (framework/transport/bvh.h), in
// its local space: exact, whatever the eye sees. BVH_STACK: how many children may wait.
#include "include/surfaces/point_on_triangle.glsl"
#include "framework/transport/bvh.h"

uniform usamplerBuffer bvhNodes;   // four texels each
uniform samplerBuffer bvhCorners;  // three a triangle, two texels each
layout(std430) readonly buffer BvhSources {
    BvhSource bvhSources[];
};
uniform mat4 localFromEye;  // rigid
uniform float localRounding;  // that local coordinates may be off by, m

BvhNode bvhNodeAt(uint number) {
    int texel = int(4u * number);
    uvec4 first = texelFetch(bvhNodes, texel);
    BvhNode node;
    node.origin = uintBitsToFloat(first.xyz);
    node.exponents = first.w;
    node.children = texelFetch(bvhNodes, texel + 1);
    node.lower = texelFetch(bvhNodes, texel + 2);
    node.upper = texelFetch(bvhNodes, texel + 3);
    return node;
}

// `corner`: 0 to 2.
vec3 bvhPositionAt(uint triangle, uint corner) {
    return texelFetch(bvhCorners, int(6u * triangle + 2u * corner)).xyz;
}
VertexData bvhCornerAt(uint triangle, uint corner) {
    int texel = int(6u * triangle + 2u * corner);
    vec4 position = texelFetch(bvhCorners, texel);
    vec4 normal = texelFetch(bvhCorners, texel + 1);
    return VertexData(position.xyz, position.w, normal.xyz, normal.w);
}

struct BvhRay {
    vec3 origin;
    vec3 direction;  // unit
};

BvhRay bvhRay(vec3 positionVs, vec3 directionVs) {
    return BvhRay((localFromEye * vec4(positionVs, 1.0)).xyz, mat3(localFromEye) * directionVs);
}
vec3 localToEye(vec3 direction) { return direction * mat3(localFromEye); }

struct BvhHit {
    float distance;  // m
    uint triangle;   // of the hierarchy; kBvhNone: none
};

// Whether a triangle that the ray crosses is one that it hits: whoever includes this says so.
// `normal`: unit, by its winding; `height`: of the ray's origin above its plane, m.
bool isSurfaceHit(BvhRay ray, uint triangle, vec3 normal, float height);

// On which side a ray from the origin passes an edge, as a volume (the edge's Pluecker coordinates):
// of the two triangles that share one exactly opposite numbers, so that no ray slips between them.
float sideOfEdge(vec3 from, vec3 to, vec3 direction) {
    precise vec3 edge = to - from;
    precise vec3 sum = to + from;
    precise vec3 moment = vec3(edge.y * sum.z - edge.z * sum.y, edge.z * sum.x - edge.x * sum.z,
                               edge.x * sum.y - edge.y * sum.x);
    precise float side = moment.x * direction.x + moment.y * direction.y + moment.z * direction.z;
    return side;
}

// The sides of the edges that lie across from each corner: its weights, up to their sum. `corners`
// are from the ray's origin.
vec3 sidesOfEdges(vec3 corners[3], vec3 direction) {
    return vec3(sideOfEdge(corners[1], corners[2], direction),
                sideOfEdge(corners[2], corners[0], direction),
                sideOfEdge(corners[0], corners[1], direction));
}

void testTriangle(BvhRay ray, uint triangle, inout BvhHit best) {
    vec3 positions[3];
    vec3 corners[3];
    for (uint i = 0u; i < 3u; ++i) {
        positions[i] = bvhPositionAt(triangle, i);
        corners[i] = positions[i] - ray.origin;
    }
    vec3 sides = sidesOfEdges(corners, ray.direction);
    if (min(sides.x, min(sides.y, sides.z)) < 0.0 && max(sides.x, max(sides.y, sides.z)) > 0.0)
        return;
    // Not of the corners from the origin, whose rounding turns the normal of a sliver.
    vec3 area = cross(positions[1] - positions[0], positions[2] - positions[0]);
    float closing = dot(ray.direction, area);
    float rise = dot(corners[0], area);
    float t = rise / closing;
    if (!(t >= 0.0 && t < best.distance)) return;
    float size = length(area);
    if (!(size > 0.0)) return;
    if (isSurfaceHit(ray, triangle, area / size, -rise / size)) best = BvhHit(t, triangle);
}

// Where a ray enters the four children of a node, m; further than `farthest` where it does not
// before that.
vec4 entriesOf(BvhNode node, vec3 origin, vec3 inverse, float farthest) {
    vec4 entries = vec4(3.4e38);
    for (uint i = 0u; i < kBvhWidth; ++i) {
        if (node.children[i] == kBvhNone) continue;
        vec3 lower = (bvhCorner(node.origin, node.exponents, node.lower, i) - origin) * inverse;
        vec3 upper = (bvhCorner(node.origin, node.exponents, node.upper, i) - origin) * inverse;
        vec3 first = min(lower, upper);
        vec3 last = max(lower, upper);
        float enters = max(first.x, max(first.y, max(first.z, 0.0)));
        // By a few roundings more, so that no box is missed whose triangle is hit (Ize 2013).
        float leaves = min(last.x, min(last.y, last.z)) * 1.000001;
        if (enters <= leaves && enters < farthest) entries[i] = enters;
    }
    return entries;
}

void orderTwo(inout float a, inout uint childA, inout float b, inout uint childB) {
    if (a <= b) return;
    float nearer = b;
    uint nearerChild = childB;
    b = a;
    childB = childA;
    a = nearer;
    childA = nearerChild;
}

// Children that wait, the nearest last, and the bits of where the ray enters them.
uvec2 bvhWaiting[BVH_STACK];
int bvhWaitingCount = 0;

// The next one that the ray enters before `farthest`, m; kBvhNone: there is none.
uint nextBvhChild(float farthest) {
    uint found = kBvhNone;
    do {
        if (bvhWaitingCount > 0) {
            --bvhWaitingCount;
            uvec2 waiting = bvhWaiting[bvhWaitingCount];
            if (uintBitsToFloat(waiting.y) < farthest) found = waiting.x;
        }
    } while (found == kBvhNone && bvhWaitingCount > 0);
    return found;
}

// The nearest child of a node that the ray enters before `farthest`, m; the others wait.
uint enteredBvhChild(BvhNode node, vec3 origin, vec3 inverse, float farthest) {
    vec4 at = entriesOf(node, origin, inverse, farthest);
    uvec4 children = node.children;
    orderTwo(at.x, children.x, at.y, children.y);
    orderTwo(at.z, children.z, at.w, children.w);
    orderTwo(at.x, children.x, at.z, children.z);
    orderTwo(at.y, children.y, at.w, children.w);
    orderTwo(at.y, children.y, at.z, children.z);
    for (int i = 3; i > 0; --i) {
        if (at[i] < 3.4e38) {
            bvhWaiting[bvhWaitingCount] = uvec2(children[i], floatBitsToUint(at[i]));
            ++bvhWaitingCount;
        }
    }
    return at.x < 3.4e38 ? children.x : kBvhNone;
}

// The nearest hit before `farthest`, m; with `isAnyEnough` the first that is found.
BvhHit searchBvh(BvhRay ray, float farthest, bool isAnyEnough) {
    BvhHit best = BvhHit(farthest, kBvhNone);
    // Where a ray is parallel to an axis 0 times this is still 0.
    vec3 safe = mix(ray.direction, vec3(1e-30), lessThan(abs(ray.direction), vec3(1e-30)));
    vec3 inverse = 1.0 / safe;
    bvhWaitingCount = 0;
    uint child = 0u;
    // Down to a leaf, and then through its triangles: rays side by side do the same together. A loop
    // that asks at its end runs once less where a software rasteriser can't leave it at its begin.
    do {
        do {
            if ((child & kBvhLeaf) == 0u) {
                child = enteredBvhChild(bvhNodeAt(child), ray.origin, inverse, best.distance);
                if (child == kBvhNone) child = nextBvhChild(best.distance);
            }
        } while ((child & kBvhLeaf) == 0u);
        if (child != kBvhNone) {
            uint triangle = bvhLeafFirst(child);
            uint end = triangle + bvhLeafCount(child);
            do {
                testTriangle(ray, triangle, best);
            } while (++triangle < end);
            child = isAnyEnough && best.triangle != kBvhNone ? kBvhNone
                                                             : nextBvhChild(best.distance);
        }
    } while (child != kBvhNone);
    return best;
}

BvhHit traceBvh(BvhRay ray, float farthest) { return searchBvh(ray, farthest, false); }

// Whether the ray hits anything before `farthest`, m.
bool isBlocked(BvhRay ray, float farthest) {
    return searchBvh(ray, farthest, true).triangle != kBvhNone;
}

// How well a place is known that a picture shows, m: rasterisers move corners to the 1/256 of a
// pixel, `footprint`, and there are a few roundings.
float resolvedByPicture(vec3 positionVs, float footprint) {
    return localRounding + footprint / 128.0 + 4e-6 * length(positionVs);
}

// Of the corners of a triangle that the ray hits; they add up to 1.
vec3 weightsOfHit(BvhRay ray, uint triangle) {
    vec3 corners[3];
    for (uint i = 0u; i < 3u; ++i)
        corners[i] = bvhPositionAt(triangle, i) - ray.origin;
    vec3 weights = sidesOfEdges(corners, ray.direction);
    float sum = weights.x + weights.y + weights.z;
    return sum != 0.0 ? weights / sum : vec3(1.0 / 3.0);
}

// Of a hit, in local space.
PointOnTriangle pointOfHit(BvhRay ray, BvhHit hit) {
    vec3 positions[3];
    vec3 normals[3];
    vec2 uvs[3];
    for (uint i = 0u; i < 3u; ++i) {
        VertexData corner = bvhCornerAt(hit.triangle, i);
        positions[i] = corner.position;
        normals[i] = corner.normal;
        uvs[i] = vec2(corner.u, corner.v);
    }
    vec3 weights = weightsOfHit(ray, hit.triangle);
    vec3 area = cross(positions[1] - positions[0], positions[2] - positions[0]);
    PointOnTriangle point = PointOnTriangle(
        ray.origin + hit.distance * ray.direction,
        weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2], normalize(area),
        mat2x3(positions[1] - positions[0], positions[2] - positions[0]),
        mat2x3(normals[1] - normals[0], normals[2] - normals[0]));
#ifdef NORMAL_MAPS
    mapNormal(point, bvhSources[hit.triangle].material - 1u, uvs, weights);
#endif
    return point;
}
