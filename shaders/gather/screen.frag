// SPDX-License-Identifier: MIT
// Flux over the area that a pixel sees of its receiver.
#ifdef IS_FILTERED
uniform sampler2DArray filteredFlux;
#else
#include "include/maps/flux_sum_read.glsl"
#endif

uniform sampler2D receiver;

// 0: W; 1: W/sr towards the eye.
vec3 storedAt(ivec2 pixel, int set) {
#ifdef IS_FILTERED
    return texelFetch(filteredFlux, ivec3(pixel, set), 0).rgb;
#else
    return fluxAt(pixel, set == 0 ? kFluxPart : kIntensityPart);
#endif
}

layout(location = 0) out vec4 irradiance;
#ifdef HAS_INTENSITY
layout(location = 1) out vec4 radiance;
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float area = texelFetch(receiver, pixel, 0).y;
    float overArea = area > 0.0 ? 1.0 / area : 0.0;
    irradiance = vec4(storedAt(pixel, 0) * overArea, 0.0);
#ifdef HAS_INTENSITY
    radiance = vec4(storedAt(pixel, 1) * overArea, 0.0);
#endif
}
