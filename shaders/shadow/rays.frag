// SPDX-License-Identifier: MIT
// Whether a ray to a light hit nothing before it.
#include "include/photons/hits.glsl"
#include "include/photons/photons.glsl"
#include "shadow/ray_to_light.glsl"

layout(location = 0) out vec4 visibility;

uniform int lightIndex;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool isQueried = texelFetch(photonFlux, pixel, 0).r > 0.0;
    uint fate = uint(texelFetch(hitFlux, pixel, 0).w);
    bool isHit = fate == kFateReceiver || fate == kFateSpecular;
    if (isHit) {
        vec3 positionVs = texelFetch(photonPosition, pixel, 0).xyz;
        isHit = texelFetch(hitPosition, pixel, 0).w < reachOfRay(lights[lightIndex], positionVs);
    }
    visibility = vec4(isQueried && !isHit ? 1.0 : 0.0);
}
