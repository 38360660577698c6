// SPDX-License-Identifier: MIT
// A map of flux to read, and what a filter makes of it to write. One thread a texel.
#include "include/maps/flux_sum_read.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2DArray filteredFlux;

uniform int setsBefore;  // of a view
uniform int setsAfter;
uniform int views;
uniform int lastIsIntensity;

bool texelOfThread(out ivec2 texel) {
    texel = ivec2(gl_GlobalInvocationID.xy);
    return all(lessThan(texel, textureSize(fluxSums, 0).xy));
}

// `units`: of the ledger; `set`: 0 flux, 1 what the last one holds.
void storeFiltered(ivec2 texel, int view, int set, vec3 units) {
    float unit = (set == 1 && lastIsIntensity == 1 ? kIntensityQuantum : 1.0) / ledgerUnitsPerWatt;
    imageStore(filteredFlux, ivec3(texel, view * setsAfter + set), vec4(units * unit, 0.0));
}

// What comes after the flux itself is kept as it is.
void keepLast(ivec2 texel) {
    if (setsAfter < 2) return;
    for (int view = 0; view < views; ++view)
        storeFiltered(texel, view, 1, sumAt(texel, view * setsBefore + setsBefore - 1));
}
