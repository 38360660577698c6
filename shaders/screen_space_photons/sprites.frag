// SPDX-License-Identifier: MIT
// Irradiance that one photon's splat adds at one pixel; where a receiver is glossy, also what of it
// goes to the eye.
#include "screen_space_photons/sprite.glsl"
#ifdef GLOSSY_RECEIVERS
#include "common/receiver_brdf.glsl"
#endif

flat in vec3 spriteCenter;
flat in vec3 spriteNormal;
flat in vec3 spriteDirection;
flat in float spriteRadius;
flat in vec3 spritePower;

layout(location = 0) out vec4 irradiance;
#ifdef GLOSSY_RECEIVERS
layout(location = 1) out vec4 radiance;
#endif

void main() {
    SpritePixel part = spriteAt(Sprite(spriteCenter, spriteNormal, spriteDirection, spriteRadius),
                                ivec2(gl_FragCoord.xy));
    if (part.where != kSpriteOn) discard;
    irradiance = vec4(spritePower * part.weight, 0.0);
#ifdef GLOSSY_RECEIVERS
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(receiverSurface, pixel, 0);
    radiance = vec4(irradiance.rgb * receiverReflection(pixel, surface, -spriteDirection), 0.0);
#endif
}
