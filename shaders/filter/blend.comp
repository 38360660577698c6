// SPDX-License-Identifier: MIT
// filter.blend: of splats of four sizes, the smallest that enough photons lie on (WD08, section
// 4.1), and what lies between enough and too few. What is kept for glossy receivers is mixed as the
// flux is that it belongs to.
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

// Of each size; their sum is 1.
float[4] weightsOf(vec3 flux[4], uint counts[4]) {
    float weights[4] = float[4](0.0, 0.0, 0.0, 0.0);
    // The smallest size of which there are enough, else the largest.
    int whole = 3;
    for (int i = 3; i >= 0; --i) {
        if (counts[i] >= uint(filter_blend_max_photons)) whole = i;
    }
    weights[whole] = 1.0;
    if (filter_blend_interpolant == filter_blend_interpolant_linear) {
        if (whole == 0) return weights;
        weights[whole - 1] = sizeWeight(counts[whole - 1]);
        weights[whole] = 1.0 - weights[whole - 1];
        return weights;
    }
    // Smaller ones join where they are brighter: up to three sizes together.
    float total = 1.0;
    float mixed = brightness(flux[whole]);
    for (int i = whole - 1; i >= max(whole - 2, 0); --i) {
        if (brightness(flux[i]) <= mixed) continue;
        float weight = sizeWeight(counts[i]);
        if (filter_blend_interpolant == filter_blend_interpolant_bernstein) {
            // Beside the 1 of the size that has enough, which this compares with.
            weights[i] = weight;
            total += weight;
            continue;
        }
        // It takes over from what the larger ones give.
        for (int larger = i + 1; larger <= whole; ++larger)
            weights[larger] *= 1.0 - weight;
        weights[i] = weight;
        mixed += weight * (brightness(flux[i]) - mixed);
    }
    for (int i = 0; i < 4; ++i)
        weights[i] /= total;
    return weights;
}

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    for (int view = 0; view < views; ++view) {
        vec3 flux[4];
        uint counts[4];
        for (int i = 0; i < 4; ++i) {
            flux[i] = sumAt(texel, firstSet(view, 0) + i);
            counts[i] = texelFetch(photonCounts, ivec3(texel, 4 * view + i), 0).x;
        }
        float weights[4] = weightsOf(flux, counts);
        for (int kind = 0; kind < setsAfter; ++kind) {
            vec3 sum = vec3(0.0);
            for (int i = 0; i < 4; ++i)
                sum += weights[i] * (kind == 0 ? flux[i] : sumAt(texel, firstSet(view, kind) + i));
            storeFiltered(texel, view, kind, sum);
        }
    }
}
