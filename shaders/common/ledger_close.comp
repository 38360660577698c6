// SPDX-License-Identifier: MIT
// Closes the ledger of a frame: what the irradiance map holds, summed over the receivers' areas,
// and photons that were still on their way when the bounces ended.
#include "common/ledger.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;
uniform sampler2D receiver;
uniform sampler2D hitFlux;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(at, textureSize(irradiance, 0)))) {
        vec3 there = texelFetch(irradiance, at, 0).rgb;
        float area = texelFetch(receiver, at, 0).y;
        // Not max(): a value that is not a number must show.
        if (there != vec3(0.0)) ledgerAdd(kAccountDeposited, there * area);
    }
    if (all(lessThan(at, textureSize(hitFlux, 0)))) {
        vec4 flux = texelFetch(hitFlux, at, 0);
        if (uint(flux.w) == kFateSpecular) ledgerAdd(kAccountBounceLimit, flux.rgb);
    }
}
