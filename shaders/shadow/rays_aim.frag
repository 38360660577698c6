// SPDX-License-Identifier: MIT
// A ray from each receiver that faces the light, back to it. It carries a flux, so that a tracer
// takes it for a photon; where no light can arrive there is none.
#include "include/photons/lights.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/photons/transfer_map.glsl"
#include "include/views/view.glsl"

layout(location = 0) out vec4 rayPosition;
layout(location = 1) out vec4 rayDirection;
layout(location = 2) out vec4 rayFlux;
layout(location = 3) out uvec4 rayOrigin;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform int lightIndex;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(receiver, pixel, 0).x;
    Photon ray = Photon(vec3(0.0), 0.0, vec3(0.0), kFateNone, vec3(0.0), 0u);
    if (depth > 0.0) {
        ray.positionVs = viewRay(gl_FragCoord.xy) * depth;
        ray.directionVs = -lightDirection(lights[lightIndex], ray.positionVs);
        vec4 surface = texelFetch(receiverSurface, pixel, 0);
        bool isTurned = isOpen(uint(surface.w) - 1u) && dot(surface.xyz, ray.positionVs) > 0.0;
        float cosine = dot(isTurned ? -surface.xyz : surface.xyz, ray.directionVs);
        if (cosine > 0.0) {
            ray.fate = kFateInFlight;
            ray.fluxWatts = vec3(1.0);
            ray.media = withLeftSide(0u, kLeftBothSides);
        }
    }
    rayPosition = photonPositionTexel(ray);
    rayDirection = photonDirectionTexel(ray);
    rayFlux = photonFluxTexel(ray);
    uint cell = uint(pixel.y) * uint(view.sizePixels.x) + uint(pixel.x);
    rayOrigin = originTexel(PhotonOrigin(cell, uint(lightIndex), kEmittedPath, 0u, 0u));
}
