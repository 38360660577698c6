// SPDX-License-Identifier: MIT
// Irradiance that one photon's splat adds at one pixel.
#include "screen_space_photons/sprite.glsl"

flat in vec3 spriteCenter;
flat in vec3 spriteNormal;
flat in vec3 spriteDirection;
flat in float spriteRadius;
flat in vec3 spritePower;

layout(location = 0) out vec4 irradiance;

void main() {
    SpritePixel part = spriteAt(Sprite(spriteCenter, spriteNormal, spriteDirection, spriteRadius),
                                ivec2(gl_FragCoord.xy));
    if (part.where != kSpriteOn) discard;
    irradiance = vec4(spritePower * part.weight, 0.0);
}
