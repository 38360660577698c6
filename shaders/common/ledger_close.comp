// SPDX-License-Identifier: MIT
// Closes the ledger of a frame: what the map of flux holds, and photons that were still on their
// way when the bounces ended. A thread a texel of the map or a photon of the last list.
#include "common/flux_sum_read.glsl"
#include "common/hits.glsl"
#include "common/ledger.glsl"
#include "common/photons.glsl"

layout(local_size_x = 64) in;

void main() {
    uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
#ifdef SUMS_MAP
    uint width = uint(textureSize(fluxSums, 0).x);
    if (index >= width * uint(textureSize(fluxSums, 0).y)) return;
    ivec2 texel = ivec2(index % width, index / width);
    bool isLit = false;
    for (int channel = 0; channel < 3; ++channel) {
        uvec2 words = fluxWords(texel, kFluxPart, channel);
        isLit = isLit || words != uvec2(0u);
        ledgerAddUnits(kAccountDeposited, words.x, words.y);
    }
    if (isLit) atomicAdd(ledger[kAccountDeposited].events, 1u);
#else
    if (index >= photons.count) return;
    vec4 flux = texelFetch(hitFlux, ivec2(photonTexel(photons, index)), 0);
    if (uint(flux.w) == kFateSpecular) ledgerAdd(kAccountBounceLimit, flux.rgb);
#endif
}
