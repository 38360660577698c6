// SPDX-License-Identifier: MIT
// The medium before what a pixel sees: its transmittance along the straight eye ray, to the
// receiver or mirror there, or else to the end of the scene, where the medium ends for a ray that
// hits nothing; and, with SCATTERS, the light that it scatters towards the eye. Radiance, W/m²/sr.
#include "include/photons/medium.glsl"

layout(location = 0) out vec4 radiance;

uniform sampler2D receiver;
uniform sampler2D seenRadiance;
#ifdef SCATTERS
uniform sampler2D inScattered;
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = viewRay(gl_FragCoord.xy);
    float depth = abs(texelFetch(receiver, pixel, 0).x);  // negative for a mirror
    if (depth == 0.0) {
        vec2 inScene = boundsInterval(vec3(0.0), ray);
        depth = inScene.x < inScene.y ? max(inScene.y, 0.0) : 0.0;
    }
    vec3 left = transmittanceOver(view.mediumExtinction.rgb, depth * length(ray));
    radiance = vec4(texelFetch(seenRadiance, pixel, 0).rgb * left, 1.0);
#ifdef SCATTERS
    radiance.rgb += texelFetch(inScattered, pixel, 0).rgb;
#endif
}
