// SPDX-License-Identifier: MIT
// Whether two places of a view show one surface, as far as pixels tell.
#include "include/views/view.glsl"

// Cosine between the normals of what is one surface, curved or bent by less than that.
const float kMinSameCosine = 0.9;

// Whether a receiver that is seen at a place in the view, px, at this depth, m, not of a mirror, and
// with this unit normal lies on a plane through a point. `margin`: of what the plane was seen by, m.
bool continuesPlane(vec3 point, vec3 normal, float margin, vec2 place, float depth,
                    vec3 seenNormal) {
    if (depth <= 0.0 || dot(seenNormal, normal) < kMinSameCosine) return false;
    vec3 ray = viewRay(place);
    float facing = dot(normal, ray);
    if (abs(facing) < 1e-4) facing = facing < 0.0 ? -1e-4 : 1e-4;
    float onPlane = dot(normal, point) / facing;
    return abs(depth - onPlane) <= margin + depthMargin(ray, depth, seenNormal);
}
