// SPDX-License-Identifier: MIT
// Radiance of the receivers on the straight eye rays, W/m²/sr: direct light, the caustic and the
// fill light, reflected diffusely; the background where there is no receiver.
#include "common/view.glsl"

layout(location = 0) out vec4 radiance;

uniform sampler2D receiver;
uniform sampler2D receiverAlbedo;
uniform sampler2D directIrradiance;
uniform sampler2D causticIrradiance;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance = vec4(view.background.rgb, 1.0);
    if (texelFetch(receiver, pixel, 0).x <= 0.0) return;
    vec3 irradiance = texelFetch(directIrradiance, pixel, 0).rgb +
                      texelFetch(causticIrradiance, pixel, 0).rgb + view.ambient.rgb;
    radiance.rgb = texelFetch(receiverAlbedo, pixel, 0).rgb * irradiance * (1.0 / 3.14159265);
}
