// SPDX-License-Identifier: MIT
// A ray from each receiver that faces the light, back to it, as a photon for the tracers.
#include "shadow/ray_to_light.glsl"

layout(location = 0) out vec4 rayPosition;
layout(location = 1) out vec4 rayDirection;
layout(location = 2) out vec4 rayFlux;
layout(location = 3) out uvec4 rayOrigin;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform int lightIndex;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Photon ray = rayToLight(pixel, texelFetch(receiver, pixel, 0),
                            texelFetch(receiverSurface, pixel, 0), lights[lightIndex]);
    rayPosition = photonPositionTexel(ray);
    rayDirection = photonDirectionTexel(ray);
    rayFlux = photonFluxTexel(ray);
    uint cell = uint(pixel.y) * uint(view.sizePixels.x) + uint(pixel.x);
    rayOrigin = originTexel(PhotonOrigin(cell, uint(lightIndex), kEmittedPath, 0u, 0u));
}
