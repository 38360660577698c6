// SPDX-License-Identifier: MIT
// From which side a ray hits a surface: the same rule for every tracer, the reference's included
// (framework/reference/embree_scene.cpp).
#include "include/surfaces/specular.glsl"

struct TracedRay {
    vec3 origin;
    vec3 direction;
    uint media;
    uvec4 around;  // the innermost dielectrics
};

TracedRay tracedRay(vec3 origin, vec3 direction, uint media) {
    return TracedRay(origin, direction, media, innerMedia(media));
}

bool isAround(TracedRay ray, uint medium) {
    return any(equal(ray.around, uvec4(medium)));
}

// A photon inside a dielectric can hit that dielectric only from within, any other dielectric and
// any closed mirror only from outside. So a ray never hits the surface that it has just left, at
// any scale (hard case 10); receivers end it from either side, and so do open mirrors, but for the
// one that it has left on that side and is still no farther from than a pixel resolves. A
// dielectric farther out may end inside of the innermost, where they overlap; a ray that has just
// left a body of the same glass within that is told by the distance, too.
// `normal`: the triangle's, outward; `height`: the ray's origin above its plane, m.
bool isFacing(TracedRay ray, uint material, vec3 normal, float height, float resolved) {
    if (leftSide(ray.media) == kLeftBothSides) return abs(height) > resolved;
    uint kind = materialKind(material - 1u);
    if (isReceiver(kind)) return true;
    bool leaves = dot(ray.direction, normal) > 0.0;
    if (kind == kMaterialMirror && isOpen(material - 1u)) {
        uint left = leaves ? kLeftOutside : kLeftInside;
        return leftSide(ray.media) != left || abs(height) > resolved;
    }
    if (kind == kMaterialMirror) return !leaves;
    bool isInside = ray.around.x == material;
    if (!leaves || isInside) return leaves == isInside;
    return abs(height) > resolved && isAround(ray, material);
}
