// SPDX-License-Identifier: MIT
// A ray of the eye from mirror to mirror.
#include "include/surfaces/dielectrics.glsl"

// A ray at mirrors.
struct MirrorPath {
    vec3 origin;     // of its last piece
    vec3 direction;  // unit
    vec3 share;      // of the radiance that mirrors and the medium leave
    uint media;
    int mirrors;     // that it has hit
};

// The path goes on reflected at a mirror (material index + 1) with this outward normal.
void reflectAt(inout MirrorPath path, vec3 positionVs, vec3 normal, uint material) {
    bool enters = dot(path.direction, normal) < 0.0;
    path.origin = positionVs;
    path.direction = normalize(reflect(path.direction, normal));
    path.share *= materials[material - 1u].albedo.rgb;
    uint left = isOpen(material - 1u) ? (enters ? kLeftOutside : kLeftInside) : kLeftNone;
    path.media = withLeftSide(path.media, left);
    ++path.mirrors;
}
