// SPDX-License-Identifier: MIT
// Where the light of probes arrives in the view that a metric looks from, and what they have met.
// One thread a hit. BY_PHOTON: an entry a photon.
#include "include/photons/arriving.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/views/seen_receiver.glsl"
#include "techniques/light_cells/landing_data.h"
#ifdef PATHS
#include "include/views/ray_segment.glsl"
#endif

layout(std430) buffer Landings {
    Landing landings[];
};
uniform int isFirst;     // of the views that these hits are looked at from
uniform int viewNumber;  // of the first of them
uniform int needsSight;  // 1: what the view does not see has not landed
uniform int isPart;      // 1: of a view that has been looked from; next to this one that holds
#ifndef BY_PHOTON
uniform int branches;    // entries of a probe
layout(std430) readonly buffer ProbeNumbers {
    uint probeNumbers[];
};
#endif

// Entries of a probe are the photons that it has become, as many as there are entries; the last one
// is of all that are left over: the first of these is noted there, and what the others have met.
// Whichever thread comes first, an entry becomes the same.
uint entryOf(PhotonOrigin origin, uint index, out bool isNoted) {
    isNoted = true;
#ifdef BY_PHOTON
    return index;
#else
    uint branch = origin.branch & 0xffu;
    uint last = uint(branches - 1);
    isNoted = branch <= last;
    return probeNumbers[index] * uint(branches) + min(branch, last);
#endif
}

// Of a path and the surface at its end; sums of these tell paths apart, in any order.
uint signatureOf(PhotonOrigin origin, uint material) {
    uint number = origin.path * 747796405u + material * 2891336453u + 277803737u;
    number = (number ^ (number >> 16u)) * 2246822519u;
    return number ^ (number >> 13u);
}

#ifdef PATHS
uniform float farthest;  // that a path goes, m

// Both ends of the part of a path that the eye sees, as the screen has them.
void storePathLanding(uint entry, ivec2 texel, uint fate) {
    vec3 begin = texelFetch(photonPosition, texel, 0).xyz;
    vec3 along = texelFetch(photonDirection, texel, 0).xyz;
    bool isHit = fate == kFateReceiver || fate == kFateSpecular;
    float length = isHit ? texelFetch(hitPosition, texel, 0).w : farthest;
    // The part that is on the screen, or so near to it that a wide line may reach there.
    float first = 0.0;
    float last = length;
    cutToNearPlane(begin, along, first, last);
    cutToScreen(begin, along, 1.25 * view.frustum.xy, first, last);
    if (!(first < last)) return;
    landings[entry].ends = vec4(pixelOf(begin + last * along), pixelOf(begin + first * along));
    landings[entry].seenBy = 1u;
}
#endif

// Next to what the view holds too: neighbours there are told apart as well.
bool isInFront(vec3 point) { return point.z < -view.frustum.z; }

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    uint fate = uint(texelFetch(hitFlux, texel, 0).w);
    PhotonOrigin origin = originAt(texel);
    bool isNoted;
    uint entry = entryOf(origin, index, isNoted);
    vec4 surface = texelFetch(hitSurface, texel, 0);
    if (isFirst == 1 && fate != kFateNone)
        atomicAdd(landings[entry].signature, signatureOf(origin, uint(surface.w)));
    if (!isNoted) return;
#ifdef PATHS
    if (uint(texelFetch(photonDirection, texel, 0).w) == kFateInFlight) storePathLanding(entry, texel, fate);
    return;
#endif
    if (!hasArrived(texel)) return;
    vec3 positionVs = texelFetch(hitPosition, texel, 0).xyz;
    vec3 directionVs = texelFetch(photonDirection, texel, 0).xyz;
    for (int face = 0; face < viewCount; ++face) {
#ifdef MANY_VIEWS
        viewIndex = face;
#endif
        vec3 point = pointFromEye(positionVs);
        if (!isInFront(point)) continue;
        vec2 at = pixelOf(point);
        bool isWithin = all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, view.sizePixels.xy));
        // The faces of a cube share out all directions between them.
        if (!isWithin && (viewCount > 1 || needsSight == 1 || isPart == 1)) continue;
        vec3 normal = directionFromEye(surface.xyz);
        float depth = -point.z;
        if (needsSight == 1) {
            float area = 0.0;
            if (seenAt(ivec2(at), depth, normal, 4.0 * pixelFootprint(depth), area) != kSeenOn)
                continue;
        }
        landings[entry].ends = vec4(at, 0.0, 0.0);
        landings[entry].seenBy = uint(viewNumber + face) + 1u;
    }
}
