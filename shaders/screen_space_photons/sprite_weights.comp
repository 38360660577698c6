// SPDX-License-Identifier: MIT
// What each splat's weights sum to over the pixels' areas, so that exactly the photon's flux is
// deposited at every orientation, size and distance (METHODS.md, section 7: sampled at pixel
// centres a kernel of few pixels does not sum to 1). The part hidden from the eye or off the screen
// goes to the ledger; the part that hangs off the surface's edge is redistributed on it. One thread
// a photon.
#include "common/ledger.glsl"
#include "common/surface_data.glsl"
#include "screen_space_photons/sprite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2D spriteWeights;
layout(std430) buffer CutSprites {
    Narrowed cutSprites;
};
uniform sampler2D photonPosition;
uniform sampler2D photonDirection;
uniform sampler2D hitPosition;
uniform sampler2D hitSurface;
uniform sampler2D hitFlux;

// Whether the eye looks at the side of the surface on which light arrives.
bool seesLitSide(Sprite sprite) {
    bool isEyeInFront = dot(sprite.normal, sprite.center) < 0.0;
    return isEyeInFront == (dot(sprite.normal, sprite.direction) < 0.0);
}

void main() {
    ivec2 mapSize = textureSize(hitFlux, 0);
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, mapSize))) return;
    vec4 flux = texelFetch(hitFlux, texel, 0);
    if (uint(flux.w) != kFateReceiver) {
        imageStore(spriteWeights, texel, vec4(0.0));
        return;
    }
    vec4 surface = texelFetch(hitSurface, texel, 0);
    Sprite sprite;
    sprite.center = texelFetch(hitPosition, texel, 0).xyz;
    sprite.normal = surface.xyz;
    sprite.direction = texelFetch(photonDirection, texel, 0).xyz;
    if (isOpen(uint(surface.w) - 1u) && !seesLitSide(sprite)) {
        ledgerAdd(kAccountOccludedSplat, flux.rgb);
        imageStore(spriteWeights, texel, vec4(0.0));
        return;
    }
    float wanted = reconstruct_sprites_radius > 0.0
                       ? reconstruct_sprites_radius
                       : reconstruct_sprites_footprints * texelFetch(photonPosition, texel, 0).w;
    float pixel = pixelFootprint(-sprite.center.z);
    float largest = float(reconstruct_sprites_maximum) * pixel;
    sprite.radius = clamp(wanted, pixel, largest);

    float on = 0.0;
    float occluded = 0.0;
    float offScreen = 0.0;
    ivec2 reach = spriteReach(sprite);
    ivec2 middle = ivec2(floor(pixelOf(sprite.center)));
    for (int y = -reach.y; y <= reach.y; ++y) {
        for (int x = -reach.x; x <= reach.x; ++x) {
            SpritePixel part = spriteAt(sprite, middle + ivec2(x, y));
            float amount = part.weight * part.area;
            if (part.where == kSpriteOn) on += amount;
            if (part.where == kSpriteOccluded) occluded += amount;
            if (part.where == kSpriteOffScreen) offScreen += amount;
        }
    }
    float total = on + occluded + offScreen;
    vec4 weights = vec4(0.0);
    if (total > 0.0) {
        float shrunkFrom = wanted > largest ? wanted / pixel : 0.0;
        weights = vec4(1.0 / total, sprite.radius, on / total, shrunkFrom);
        vec2 whole = wholeReach(sprite);
        float farther = max(whole.x, whole.y);
        if (farther > float(reconstruct_sprites_reach)) {
            atomicAdd(cutSprites.count, 1u);
            atomicMax(cutSprites.widestBits, floatBitsToUint(farther));
        }
        if (occluded > 0.0) ledgerAdd(kAccountOccludedSplat, flux.rgb * (occluded / total));
        if (offScreen > 0.0) ledgerAdd(kAccountOffScreen, flux.rgb * (offScreen / total));
    } else {
        // No pixel shows the surface where the light arrives: it is turned away and hidden by its own
        // object, or it is edge-on or below a pixel.
        bool isTurnedAway = dot(sprite.normal, sprite.center) > 0.0;
        ledgerAdd(isTurnedAway ? kAccountOccludedSplat : kAccountEdgeOn, flux.rgb);
    }
    imageStore(spriteWeights, texel, weights);
}
