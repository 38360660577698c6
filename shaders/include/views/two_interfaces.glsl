// SPDX-License-Identifier: MIT
// Where a ray that has entered a body leaves it, in image space (W05, as K06, WD08 and WN09 describe
// it): at a distance between that to the back faces along the view's ray, d_V, and that along the
// inverse normal, d_N. The weight of d_V is the ratio of the angles of refraction and incidence:
// right for an index of 1, where the ray goes straight on, and for one without limit, where it
// follows the normal. For any view from which rays come: the eye's, or a light's for its photons.
// Of which buffers the faces are says whoever includes this (include/views/faces.glsl).
#include "include/views/faces.glsl"

// Depth of the back faces, 0 where there are none.
float backDepthAt(ivec2 texel) { return depthOfFace(texel, kBackFace); }

// From a point of the front along `direction`, unit, to the back faces, m: a point on that way is
// inside as long as these lie beyond it. In steps that grow, from a quarter of what the view's ray
// has before it (`through`), then by bisection; `steps` that never come out are as far as they go.
// The paper's along the normal is precomputed for every vertex; this needs no preparation.
float distanceInside(vec3 entry, vec3 direction, float through, int steps) {
    float inside = 0.0;
    float step = max(0.25 * through, pixelFootprint(max(-entry.z, view.frustum.z)));
    bool isOut = false;
    for (int i = 0; i < steps; ++i) {
        vec3 p = entry + direction * (inside + step);
        float back = backDepthAt(texelAt(p));
        isOut = back <= 0.0 || -p.z > back;
        if (isOut) break;
        inside += step;
        step *= 1.6;
    }
    if (!isOut) return inside;
    // Between the last point inside and the first one outside.
    float outside = inside + step;
    for (int i = 0; i < 8; ++i) {
        float middle = 0.5 * (inside + outside);
        vec3 p = entry + direction * middle;
        float back = backDepthAt(texelAt(p));
        if (back <= 0.0 || -p.z > back) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    return 0.5 * (inside + outside);
}

struct InnerPath {
    float lengthMeters;
    vec3 exit;
    vec3 normal;   // of the back faces there, outward, unit
    ivec2 texel;   // of the back buffers that it is from
};

// How far it is from the front to the back faces along the refracted ray.
const int kEstimates = 0;  // W05: between d_V and d_N
const int kSearch = 1;     // along the ray itself, as if the back faces were all there is

// `entry`: where the ray has met the front; `along`: unit, in which it came; `onward`: unit, in
// which it goes on; `normal`: outward, unit; `through`: from the front to the back faces along the
// view's ray, m, more than 0; `index`: of the body, by that around; `steps`: 0 for d_V alone.
InnerPath innerPath(vec3 entry, vec3 along, vec3 onward, vec3 normal, float through, float index,
                    int steps, int distances) {
    float inside = through;
    if (steps > 0 && distances == kSearch) {
        inside = distanceInside(entry, onward, through, steps);
    } else if (steps > 0) {
        float cosI = clamp(-dot(along, normal), 0.0, 1.0);
        float cosT = clamp(-dot(onward, normal), 0.0, 1.0);
        float angleI = acos(cosI);
        float weight = angleI > 1e-3 ? acos(cosT) / angleI : 1.0 / index;
        inside = weight * through + (1.0 - weight) * distanceInside(entry, -normal, through, steps);
    }
    vec3 exit = entry + inside * onward;
    // Beside the silhouette: the last pixel on the way there that has back faces.
    ivec2 there = texelAt(exit);
    const int kTries = 8;
    for (int i = 1; i <= kTries && backDepthAt(there) <= 0.0; ++i)
        there = texelAt(mix(exit, entry, float(i) / float(kTries)));
    return InnerPath(inside, exit, normalAround(exit, there, kBackFace), there);
}
