// SPDX-License-Identifier: MIT
// Whether a ray to a light hit nothing before it.
#include "include/photons/hits.glsl"
#include "include/photons/lights.glsl"
#include "include/photons/photons.glsl"

layout(location = 0) out vec4 visibility;

uniform int lightIndex;

// A light's own surface, on which the light lies, is not in its way by rounding: as a share of the way.
const float kOwnSurface = 1e-4;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool isQueried = texelFetch(photonFlux, pixel, 0).r > 0.0;
    uint fate = uint(texelFetch(hitFlux, pixel, 0).w);
    bool isHit = fate == kFateReceiver || fate == kFateSpecular;
    LightData light = lights[lightIndex];
    if (isHit && uint(light.positionVs.w) != kLightDirectional) {
        float toLight = distance(light.positionVs.xyz, texelFetch(photonPosition, pixel, 0).xyz);
        isHit = texelFetch(hitPosition, pixel, 0).w < (1.0 - kOwnSurface) * toLight;
    }
    visibility = vec4(isQueried && !isHit ? 1.0 : 0.0);
}
