// SPDX-License-Identifier: MIT
// One sprite a photon: a square on the screen around its disc. A strip of four vertices instead of
// a point, since points end at a device's largest size and vanish with their centre.
#include "screen_space_photons/sprite.glsl"

uniform int firstPhoton;  // of the batch
uniform sampler2D spriteWeights;
uniform sampler2D photonDirection;
uniform sampler2D hitPosition;
uniform sampler2D hitSurface;
uniform sampler2D hitFlux;

flat out vec3 spriteCenter;
flat out vec3 spriteNormal;
flat out vec3 spriteDirection;
flat out float spriteRadius;
flat out vec3 spritePower;  // flux over the sum of the weights, W/m²

void main() {
    ivec2 mapSize = textureSize(hitFlux, 0);
    int photon = firstPhoton + gl_InstanceID;
    ivec2 texel = ivec2(photon % mapSize.x, photon / mapSize.x);
    vec4 weights = texelFetch(spriteWeights, texel, 0);
    spriteCenter = texelFetch(hitPosition, texel, 0).xyz;
    spriteNormal = texelFetch(hitSurface, texel, 0).xyz;
    spriteDirection = texelFetch(photonDirection, texel, 0).xyz;
    spriteRadius = weights.y;
    spritePower = texelFetch(hitFlux, texel, 0).rgb * weights.x;
    gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
    if (weights.z <= 0.0) return;
    ivec2 reach = spriteReach(Sprite(spriteCenter, spriteNormal, spriteDirection, spriteRadius));
    vec2 middle = floor(pixelOf(spriteCenter)) + 0.5;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec2 pixel = middle + corner * (vec2(reach) + 0.5);
    gl_Position = vec4(pixel * view.sizePixels.zw * 2.0 - 1.0, 0.0, 1.0);
}
