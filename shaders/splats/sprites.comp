// SPDX-License-Identifier: MIT
// Each pixel's share of a splat, so that exactly the photon's flux is deposited at every
// orientation, size and distance (sampled at pixel centres a kernel of few pixels does not sum to
// 1). One thread a photon.
#include "include/surfaces/surface_data.glsl"
#include "splats/splat.glsl"
#include "include/maps/deposit.glsl"

layout(std430) readonly buffer SplatTotals {
    float splatTotals[];
};

void depositInView(Sprite sprite, vec3 flux, float total) {
    if (!isNearView(sprite)) return;
    ivec2 reach = spriteReach(sprite);
    ivec2 middle = ivec2(floor(pixelOf(sprite.center)));
    ivec2 first = max(middle - reach, ivec2(0));
    ivec2 last = min(middle + reach, ivec2(view.sizePixels.xy) - 1);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            SpritePixel part = spriteAt(sprite, ivec2(x, y));
            if (part.where == kSeenOn && part.weight > 0.0)
                depositFlux(ivec2(x, y), flux * (part.weight * part.area / total),
                            directionToEye(sprite.direction));
        }
    }
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    float total = splatTotals[index];
    if (total <= 0.0) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    vec3 flux = texelFetch(hitFlux, texel, 0).rgb;
    float wanted;
    float largest;
#ifdef MANY_VIEWS
    for (viewIndex = 0; viewIndex < viewCount; ++viewIndex)
#endif
        depositInView(splatOf(texel, wanted, largest), flux, total);
}
