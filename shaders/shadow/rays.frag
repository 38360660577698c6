// SPDX-License-Identifier: MIT
// Whether a ray to a light hit nothing before it.
#include "include/hits.glsl"
#include "include/lights.glsl"
#include "include/photons.glsl"

layout(location = 0) out vec4 visibility;

uniform int lightIndex;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool isAsked = texelFetch(photonFlux, pixel, 0).r > 0.0;
    uint fate = uint(texelFetch(hitFlux, pixel, 0).w);
    bool isHit = fate == kFateReceiver || fate == kFateSpecular;
    LightData light = lights[lightIndex];
    if (isHit && uint(light.positionVs.w) != kLightDirectional) {
        float toLight = distance(light.positionVs.xyz, texelFetch(photonPosition, pixel, 0).xyz);
        isHit = texelFetch(hitPosition, pixel, 0).w < toLight;
    }
    visibility = vec4(isAsked && !isHit ? 1.0 : 0.0);
}
