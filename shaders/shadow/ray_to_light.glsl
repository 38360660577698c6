// SPDX-License-Identifier: MIT
// The ray from what a pixel shows of a receiver back to a light.
#include "include/photons/lights.glsl"
#include "include/photons/transfer_map.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/views/view.glsl"

// A light's own surface, on which the light lies, is not in its way by rounding: as a share of the way.
const float kOwnSurface = 1e-4;

// `receiver`, `receiverSurface`: the pixel's texels. Where the receiver faces the light the ray
// carries a flux, so that a tracer takes it for a photon; where no light can arrive it has none.
Photon rayToLight(ivec2 pixel, vec4 receiver, vec4 receiverSurface, LightData light) {
    Photon ray = Photon(vec3(0.0), 0.0, vec3(0.0), kFateNone, vec3(0.0), 0u);
    if (!(receiver.x > 0.0)) return ray;
    ray.positionVs = viewRay(vec2(pixel) + 0.5) * receiver.x;
    ray.directionVs = -lightDirection(light, ray.positionVs);
    vec3 normal = receiverSurface.xyz;
    bool isTurned = isOpen(uint(receiverSurface.w) - 1u) && dot(normal, ray.positionVs) > 0.0;
    if (!(dot(isTurned ? -normal : normal, ray.directionVs) > 0.0)) return ray;
    ray.fate = kFateInFlight;
    ray.fluxWatts = vec3(1.0);
    ray.media = withLeftSide(0u, kLeftBothSides);
    return ray;
}

// Before which a hit is in the way of the light, m.
float reachOfRay(LightData light, vec3 positionVs) {
    if (uint(light.positionVs.w) == kLightDirectional) return 3.0e38;
    return (1.0 - kOwnSurface) * distance(light.positionVs.xyz, positionVs);
}
