// SPDX-License-Identifier: MIT
// Where the light of probes arrives in the view that a metric looks from, and what they have met.
// One thread a hit; PhotonOrigin::cell is the number of its probe. BY_PHOTON: an entry a photon.
#include "include/photons/arriving.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/views/seen_receiver.glsl"
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
uniform int splits;
uniform int branches;    // entries of a probe
#endif

// Entries of a probe are told apart by the first interactions of its branches.
uint entryOf(PhotonOrigin origin, uint index) {
#ifdef BY_PHOTON
    return index;
#else
    int interactions = findMSB(origin.path);
    uint branch = bitfieldExtract(origin.path, max(interactions - splits, 0), splits);
    return origin.cell * uint(branches) + min(branch, uint(branches - 1));
#endif
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
    uint entry = entryOf(origin, index);
    vec4 surface = texelFetch(hitSurface, texel, 0);
    if (isFirst == 1 && fate != kFateNone) {
        uint visited = landings[entry].signature * 31u + uint(surface.w) * 7u + origin.path;
        landings[entry].signature = visited;
    }
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
