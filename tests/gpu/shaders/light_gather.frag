// SPDX-License-Identifier: MIT
// What the light's view holds where a receiver lies, over the texel's area on the receiver.
#include "include/flux_sum_read.glsl"
#include "include/lights.glsl"
#include "include/view.glsl"

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform mat4 eyeToMap;
uniform float texelArea;  // m², across the light

layout(location = 0) out vec4 irradiance;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    irradiance = vec4(0.0);
    float depth = texelFetch(receiver, pixel, 0).x;
    if (depth <= 0.0) return;
    vec3 positionVs = viewRay(gl_FragCoord.xy) * depth;
    ivec2 texel = ivec2(floor((eyeToMap * vec4(positionVs, 1.0)).xy));
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, textureSize(fluxSums, 0).xy)))
        return;
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    float cosine = abs(dot(normal, lightDirection(lights[0], positionVs)));
    irradiance.rgb = fluxAt(texel, kFluxPart) * cosine / texelArea;
}
