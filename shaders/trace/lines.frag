// SPDX-License-Identifier: MIT
// One step of a photon's ray: looks the layers up at its pixel and keeps a hit's place on the ray.
#include "include/views/exit_test.glsl"
#include "include/photons/photons.glsl"
#include "trace/lines_row_texel.glsl"

flat in vec4 endPixels;
flat in vec4 ends;
flat in vec3 rayOrigin;
flat in vec3 rayDirection;
flat in int steps;
flat in ivec2 asked;
flat in int photonIndex;

layout(location = 0) out vec4 rowTexel;

void main() {
    int i = asked.x + int(gl_FragCoord.x);
    if (i >= asked.y) discard;
    RaySegment segment;
    segment.nearPixel = endPixels.xy;
    segment.farPixel = endPixels.zw;
    segment.nearNearness = ends.x;
    segment.farNearness = ends.y;
    segment.nearT = ends.z;
    segment.farT = ends.w;
    ivec2 texel = ivec2(photonTexel(photons, uint(photonIndex)));
    uint media = uint(texelFetch(photonFlux, texel, 0).w);
    TracedRay ray = tracedRay(rayOrigin, rayDirection, media);
    FirstHit found = hitOfStep(segment, ray, i, steps);
    if (found.hit.layer < 0) discard;
    bool isBefore = found.isExit && found.pixel != texelOfStep(segment, i, steps);
    rowTexel = packRowTexel(found.hit, isBefore ? i - 1 : i, found.isExit);
}
