// SPDX-License-Identifier: MIT
// What a view's pixels see of the surface that light arrives on, and to which accounts goes what
// they do not: for every reconstruction that stores light where it is seen.
#include "include/views/view.glsl"

// View depth, negative of a mirror, and area of the surface that each pixel sees.
#ifdef MANY_VIEWS
uniform sampler2DArray receiver;
uniform sampler2DArray receiverSurface;
#else
uniform sampler2D receiver;
uniform sampler2D receiverSurface;
#endif

vec2 receiverAt(ivec2 pixel) {
#ifdef MANY_VIEWS
    return texelFetch(receiver, ivec3(pixel, viewIndex), 0).xy;
#else
    return texelFetch(receiver, pixel, 0).xy;
#endif
}
vec4 receiverSurfaceAt(ivec2 pixel) {
#ifdef MANY_VIEWS
    return texelFetch(receiverSurface, ivec3(pixel, viewIndex), 0);
#else
    return texelFetch(receiverSurface, pixel, 0);
#endif
}

#ifdef OTHER_VIEW
const uint kAccountHidden = kAccountHiddenInMap;
const uint kAccountOutside = kAccountOutsideMap;
const uint kAccountBehind = kAccountOutsideMap;
#else
const uint kAccountHidden = kAccountOccludedSplat;
const uint kAccountOutside = kAccountOffScreen;
const uint kAccountBehind = kAccountBehindEye;
#endif

const int kSeenOn = 0;         // the pixel sees the surface
const int kSeenOccluded = 1;   // something nearer is in front of it
const int kSeenOutside = 2;     // the surface has ended before
const int kSeenOffScreen = 3;

// `depth`: where the surface would be at the pixel, m; `normal`: its own; `tolerance`: by which what
// is seen may be off, m. `area` becomes what the pixel sees of the surface, m², where it sees it.
int seenAt(ivec2 pixel, float depth, vec3 normal, float tolerance, inout float area) {
    vec2 seen = receiverAt(pixel);
    bool isMirror = seen.x < 0.0;
    float seenDepth = abs(seen.x);
    if (seenDepth == 0.0) return kSeenOutside;
    if (seenDepth < depth - tolerance) return kSeenOccluded;
    if (isMirror || seenDepth > depth + tolerance) return kSeenOutside;
    // A floor's light is not a wall's: of normals at right angles rounding would decide.
    const float kSameSide = 1e-4;
    if (dot(receiverSurfaceAt(pixel).xyz, normal) <= kSameSide) return kSeenOutside;
    area = seen.y;
    return kSeenOn;
}

// Where the pixel's ray through its middle meets a plane with this unit normal through a point, m in
// depth. `facing`: the normal by viewRay, not 0.
float depthOnPlane(ivec2 pixel, vec3 normal, vec3 point, float facing) {
#ifdef ORTHOGRAPHIC_VIEW
    point -= viewPoint(vec2(pixel) + 0.5, 0.0);
#endif
    return dot(normal, point) / facing;
}

// Whether a view looks at the side of a surface on which light arrives.
bool seesLitSide(vec3 position, vec3 normal, vec3 direction) {
    bool seesFront = dot(normal, viewDirection(position)) < 0.0;
    return seesFront == (dot(normal, direction) < 0.0);
}
