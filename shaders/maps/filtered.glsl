// SPDX-License-Identifier: MIT
// A map of flux to read, and what a filter makes of it to write. One thread a texel.
#include "include/maps/flux_sum_read.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2DArray filteredFlux;

uniform int setsBefore;  // of a view
uniform int fluxSets;    // the first of them; what is kept for glossy receivers follows
uniform int setsAfter;
uniform int views;
uniform int holdsIntensity;  // for glossy receivers; else where light comes from

bool texelOfThread(out ivec2 texel) {
    texel = ivec2(gl_GlobalInvocationID.xy);
    return all(lessThan(texel, textureSize(fluxSums, 0).xy));
}

// `units`: of the ledger; `kind`: 0 flux, 1 what is kept for glossy receivers. Of kinds there are
// setsAfter.
void storeFiltered(ivec2 texel, int view, int kind, vec3 units) {
    float unit = (kind == 1 && holdsIntensity == 1 ? kIntensityQuantum : 1.0) / ledgerUnitsPerWatt;
    imageStore(filteredFlux, ivec3(texel, view * setsAfter + kind), vec4(units * unit, 0.0));
}

// Where the first set of a kind lies.
int firstSet(int view, int kind) {
    return view * setsBefore + kind * fluxSets;
}
