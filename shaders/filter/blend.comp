// SPDX-License-Identifier: MIT
// filter.blend: of splats of four sizes, the smallest that enough photons lie on (WD08, section
// 4.1), and what lies between enough and too few.
#include "maps/filtered.glsl"

uniform usampler2DArray photonCounts;

// How much a size is to be trusted: 0 up to `minimum` photons, 1 from `maximum` on.
float sizeWeight(uint photons) {
    float t = clamp((float(photons) - float(filter_blend_min_photons)) /
                        max(float(filter_blend_max_photons) - float(filter_blend_min_photons), 1e-6),
                    0.0, 1.0);
    // The paper does not give the degree of its Bernstein interpolant: the cubic one is level at
    // both ends.
    return filter_blend_interpolant == filter_blend_interpolant_linear
               ? t
               : 3.0 * t * t * (1.0 - t) + t * t * t;
}

float brightness(vec3 flux) { return flux.r + flux.g + flux.b; }

vec3 blended(vec3 flux[4], uint counts[4]) {
    // The smallest size of which there are enough, else the largest.
    int whole = 3;
    for (int i = 3; i >= 0; --i) {
        if (counts[i] >= uint(filter_blend_max_photons)) whole = i;
    }
    if (filter_blend_interpolant == filter_blend_interpolant_linear) {
        if (whole == 0) return flux[0];
        return mix(flux[whole], flux[whole - 1], sizeWeight(counts[whole - 1]));
    }
    // Smaller ones join where they are brighter: up to three sizes together.
    vec3 sum = flux[whole];
    float weights = 1.0;
    for (int i = whole - 1; i >= max(whole - 2, 0); --i) {
        if (brightness(flux[i]) <= brightness(flux[whole])) continue;
        float weight = sizeWeight(counts[i]);
        sum += weight * flux[i];
        weights += weight;
    }
    return sum / weights;
}

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    for (int view = 0; view < views; ++view) {
        vec3 flux[4];
        uint counts[4];
        for (int i = 0; i < 4; ++i) {
            flux[i] = sumAt(texel, view * setsBefore + i);
            counts[i] = texelFetch(photonCounts, ivec3(texel, 4 * view + i), 0).x;
        }
        storeFiltered(texel, view, 0, blended(flux, counts));
    }
    keepLast(texel);
}
