// SPDX-License-Identifier: MIT
// What each splat's weights sum to over the pixels' areas. The part that is hidden from the view, or
// next to it, goes to the ledger; the part that hangs off the surface's edge is redistributed on it.
// One thread a photon.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/arriving.glsl"
#include "include/photons/clamped.glsl"
#include "include/surfaces/surface_data.glsl"
#include "splats/splat.glsl"

layout(std430) writeonly buffer SplatTotals {
    float splatTotals[];  // m²; 0: nothing is to be deposited
};
// Entries of the counts.
const uint kCutOff = 0u;
const uint kShrunk = 1u;

// Whether the view looks at a surface's front.
bool seesFront(Sprite sprite) {
    return dot(sprite.normal, viewDirection(sprite.center)) < 0.0;
}

// Weights, m².
struct Parts {
    float on;
    float occluded;
    float outside;
};

void addParts(Sprite sprite, inout Parts parts) {
    ivec2 reach = spriteReach(sprite);
    ivec2 middle = ivec2(floor(pixelOf(sprite.center)));
    ivec2 first = middle - reach;
    ivec2 last = middle + reach;
#ifdef MANY_VIEWS
    // What lies next to a cube's face is in another.
    first = max(first, ivec2(0));
    last = min(last, ivec2(view.sizePixels.xy) - 1);
#endif
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            SpritePixel part = spriteAt(sprite, ivec2(x, y));
            float amount = part.weight * part.area;
            if (part.where == kSeenOn) parts.on += amount;
            if (part.where == kSeenOccluded) parts.occluded += amount;
            if (part.where == kSeenOffScreen) parts.outside += amount;
        }
    }
}

float totalOf(ivec2 texel) {
    vec4 flux = texelFetch(hitFlux, texel, 0);
    if (!hasArrived(texel)) return 0.0;
    float wanted;
    float largest;
    Sprite sprite = splatOf(texel, wanted, largest);
    if (isOpen(uint(texelFetch(hitSurface, texel, 0).w) - 1u) && 
        !seesLitSide(sprite.center, sprite.normal, sprite.direction)) {
        ledgerAdd(kAccountHidden, flux.rgb);
        return 0.0;
    }
    Parts parts = Parts(0.0, 0.0, 0.0);
    float farther = 0.0;  // than which no part of the splat is from its middle, px
#ifdef MANY_VIEWS
    for (int face = 0; face < viewCount; ++face) {
        viewIndex = face;
        Sprite inFace = splatOf(texel, wanted, largest);
        if (!isNearView(inFace)) continue;
        addParts(inFace, parts);
        vec2 reach = wholeReach(inFace);
        farther = max(farther, max(reach.x, reach.y));
        sprite = inFace;
    }
    parts.outside = 0.0;  // of one face is in another
#else
    if (!isNearView(sprite)) {
        ledgerAdd(isBeforeView(sprite) ? kAccountOutside : kAccountBehind, flux.rgb);
        return 0.0;
    }
    addParts(sprite, parts);
    vec2 reach = wholeReach(sprite);
    farther = max(reach.x, reach.y);
#endif
    float total = parts.on + parts.occluded + parts.outside;
    if (total <= 0.0) {
        // No pixel shows the surface where the light arrives: it is turned away and hidden by its
        // own object, or it is edge-on or below a pixel.
        ledgerAdd(seesFront(sprite) ? kAccountEdgeOn : kAccountHidden, flux.rgb);
        return 0.0;
    }
    if (wanted > largest) countClamped(kShrunk, wanted / largest, flux.rgb);
    if (farther > float(maxReach)) countClamped(kCutOff, farther / float(maxReach), flux.rgb);
    if (parts.occluded > 0.0) ledgerAdd(kAccountHidden, flux.rgb * (parts.occluded / total));
    if (parts.outside > 0.0) ledgerAdd(kAccountOutside, flux.rgb * (parts.outside / total));
    return parts.on > 0.0 ? total : 0.0;
}

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    splatTotals[index] = totalOf(ivec2(photonTexel(photons, index)));
}
