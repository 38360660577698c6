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
#ifdef EDGE_SAMPLES
uniform sampler2D edgeReceiver;  // xy: the same; z: the pixel's number among those at an edge + 1
#endif

vec2 receiverAt(ivec2 pixel) {
#ifdef MANY_VIEWS
    return texelFetch(receiver, ivec3(pixel, viewIndex), 0).xy;
#elif defined(EDGE_SAMPLES)
    return texelFetch(edgeReceiver, pixel, 0).xy;
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

// `seen`, `seenNormal`: a receiver, as a pixel has it. `depth`: where the surface would be there, m;
// `normal`: its own; `tolerance`: by which what is seen may be off, m. `area` becomes what a pixel
// sees of the surface, m², where it sees it.
int seenOf(vec2 seen, vec3 seenNormal, float depth, vec3 normal, float tolerance,
           inout float area) {
    bool isMirror = seen.x < 0.0;
    float seenDepth = abs(seen.x);
    if (seenDepth == 0.0) return kSeenOutside;
    if (seenDepth < depth - tolerance) return kSeenOccluded;
    if (isMirror || seenDepth > depth + tolerance) return kSeenOutside;
    if (dot(seenNormal, normal) <= kSameSide) return kSeenOutside;
    area = seen.y;
    return kSeenOn;
}

// The same of what the pixel sees at its middle.
int seenAt(ivec2 pixel, float depth, vec3 normal, float tolerance, inout float area) {
    return seenOf(receiverAt(pixel), receiverSurfaceAt(pixel).xyz, depth, normal, tolerance, area);
}

// Where the ray through a place on the screen, px, meets a plane with this unit normal through a
// point, m in depth. `facing`: the normal by viewRay, not 0.
float depthOnPlane(vec2 place, vec3 normal, vec3 point, float facing) {
#ifdef ORTHOGRAPHIC_VIEW
    point -= viewPoint(place, 0.0);
#endif
    return dot(normal, point) / facing;
}

// Whether a view looks at the side of a surface on which light arrives.
bool seesLitSide(vec3 position, vec3 normal, vec3 direction) {
    bool seesFront = dot(normal, viewDirection(position)) < 0.0;
    return seesFront == (dot(normal, direction) < 0.0);
}
