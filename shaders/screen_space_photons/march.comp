// SPDX-License-Identifier: MIT
// trace.march_compute: one thread a photon.
#include "screen_space_photons/march.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2D hitPosition;
layout(rgba32f) uniform image2D hitSurface;
layout(rgba32f) uniform image2D hitFlux;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, textureSize(photonPosition, 0)))) return;
    Photon photon = photonAt(texel);
    if (photon.fate != kFateInFlight) return;  // its hit, if any, stands
    FirstHit first = march(photon, trace_march_compute_minimum, trace_march_compute_steps);
    Hit hit = deliver(photon, first);
    imageStore(hitPosition, texel, hitPositionTexel(hit));
    imageStore(hitSurface, texel, hitSurfaceTexel(hit));
    imageStore(hitFlux, texel, hitFluxTexel(hit));
}
