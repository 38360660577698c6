// SPDX-License-Identifier: MIT
// Flux over the area that a pixel sees of its receiver.
#include "include/flux_sum_read.glsl"

uniform sampler2D receiver;

layout(location = 0) out vec4 irradiance;
#ifdef HAS_INTENSITY
layout(location = 1) out vec4 radiance;
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float area = texelFetch(receiver, pixel, 0).y;
    float overArea = area > 0.0 ? 1.0 / area : 0.0;
    irradiance = vec4(fluxAt(pixel, kFluxPart) * overArea, 0.0);
#ifdef HAS_INTENSITY
    radiance = vec4(fluxAt(pixel, kIntensityPart) * overArea, 0.0);
#endif
}
