// SPDX-License-Identifier: MIT
// What each splat's weights sum to over the pixels' areas. The part hidden from the eye or off the
// screen goes to the ledger; the part that hangs off the surface's edge is redistributed on it. One
// thread a photon.
#include "include/ledger.glsl"
#include "include/surface_data.glsl"
#include "screen_space_photons/splat.glsl"

layout(std430) writeonly buffer SplatTotals {
    float splatTotals[];  // m²; 0: nothing is to be deposited
};
layout(std430) buffer CutSplats {
    Narrowed cutOff;
    Narrowed shrunk;
};

// Whether the eye looks at the side of the surface on which light arrives.
bool seesLitSide(Sprite sprite) {
    bool isEyeInFront = dot(sprite.normal, sprite.center) < 0.0;
    return isEyeInFront == (dot(sprite.normal, sprite.direction) < 0.0);
}

float totalOf(ivec2 texel) {
    vec4 flux = texelFetch(hitFlux, texel, 0);
    if (uint(flux.w) != kFateReceiver) return 0.0;
    float wanted;
    float largest;
    Sprite sprite = splatOf(texel, wanted, largest);
    if (isOpen(uint(texelFetch(hitSurface, texel, 0).w) - 1u) && !seesLitSide(sprite)) {
        ledgerAdd(kAccountOccludedSplat, flux.rgb);
        return 0.0;
    }
    // A tracer may find what no pixel is near.
    if (!(-sprite.center.z > view.tangents.z)) {
        ledgerAdd(kAccountBehindEye, flux.rgb);
        return 0.0;
    }
    vec2 beside = max(-pixelOf(sprite.center), pixelOf(sprite.center) - view.sizePixels.xy);
    if (any(greaterThan(beside, vec2(spriteReach(sprite)) + 1.0))) {
        ledgerAdd(kAccountOffScreen, flux.rgb);
        return 0.0;
    }
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
    if (total <= 0.0) {
        // No pixel shows the surface where the light arrives: it is turned away and hidden by its
        // own object, or it is edge-on or below a pixel.
        bool isTurnedAway = dot(sprite.normal, sprite.center) > 0.0;
        ledgerAdd(isTurnedAway ? kAccountOccludedSplat : kAccountEdgeOn, flux.rgb);
        return 0.0;
    }
    if (wanted > largest) {
        atomicAdd(shrunk.count, 1u);
        atomicMax(shrunk.widestBits,
                  floatBitsToUint(wanted / pixelFootprint(-sprite.center.z)));
    }
    vec2 whole = wholeReach(sprite);
    float farther = max(whole.x, whole.y);
    if (farther > float(reconstruct_sprites_reach)) {
        atomicAdd(cutOff.count, 1u);
        atomicMax(cutOff.widestBits, floatBitsToUint(farther));
    }
    if (occluded > 0.0) ledgerAdd(kAccountOccludedSplat, flux.rgb * (occluded / total));
    if (offScreen > 0.0) ledgerAdd(kAccountOffScreen, flux.rgb * (offScreen / total));
    return on > 0.0 ? total : 0.0;
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    splatTotals[index] = totalOf(ivec2(photonTexel(photons, index)));
}
