// SPDX-License-Identifier: MIT
// What all lines so far add up to, W/m²/sr.
#include "include/maps/flux_sum_read.glsl"
#include "include/surfaces/bands.glsl"

uniform float radianceScale;

layout(location = 0) out vec4 radiance;

void main() {
    vec3 sum = sumAt(ivec2(gl_FragCoord.xy), 0) * (radianceScale / ledgerUnitsPerWatt);
    radiance = vec4(rec709OfFlux(sum), 0.0);
}
