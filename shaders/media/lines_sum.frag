// SPDX-License-Identifier: MIT
// What all lines so far add up to, W/m²/sr.
#include "include/maps/flux_sum_read.glsl"

uniform float radianceScale;

layout(location = 0) out vec4 radiance;

void main() {
    radiance = vec4(sumAt(ivec2(gl_FragCoord.xy), 0) * (radianceScale / ledgerUnitsPerWatt), 0.0);
}
