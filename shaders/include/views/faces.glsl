// SPDX-License-Identifier: MIT
// Fronts and backs of bodies in some view, whichever buffers they are in: whoever includes this
// defines faceDepth and faceNormal (include/views/back_faces.glsl, where there are backs alone).
#include "include/views/view.glsl"

const int kFrontFace = 0;  // the nearest
const int kBackFace = 1;   // the farthest

float faceDepth(ivec2 texel, int face);  // m, 0 none; of a texel of the view
vec3 faceNormal(ivec2 texel, int face);  // outward, unit

ivec2 texelAt(vec3 positionVs) {
    return ivec2(floor(pixelOf(vec3(positionVs.xy, min(positionVs.z, -view.frustum.z)))));
}

// Depth at any texel, 0 where there is no such face.
float depthOfFace(ivec2 texel, int face) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(view.sizePixels.xy))))
        return 0.0;
    return faceDepth(texel, face);
}

// The normal around a point: bilinear between the pixels that have one. In front of a body another
// part of it may be: fronts that turn by more than 60 degrees from one pixel to the next are two.
vec3 normalAround(vec3 positionVs, ivec2 fallback, int face) {
    vec3 middle = faceNormal(fallback, face);
    vec2 corner = pixelOf(vec3(positionVs.xy, min(positionVs.z, -view.frustum.z))) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = first + step;
        if (depthOfFace(texel, face) <= 0.0) continue;
        vec3 normal = faceNormal(texel, face);
        if (face == kFrontFace && dot(normal, middle) < 0.5) continue;
        vec2 axis = mix(1.0 - f, f, vec2(step));
        sum += axis.x * axis.y * normal;
    }
    float size = length(sum);
    return size > 1e-3 ? sum / size : middle;
}
