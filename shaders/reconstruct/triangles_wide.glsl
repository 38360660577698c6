// SPDX-License-Identifier: MIT
// Patches that cover many pixels, made once and kept for those who cover them.
#include "reconstruct/triangles_patch.glsl"

struct WidePatch {
    vec4 corners[4];  // xyz, m; w: the density there
    vec4 normal;      // xyz; w: the share of the flux in the first of its triangles
    vec4 direction;   // xyz; w: its tolerance, m
    vec4 flux;        // rgb, W; w: 1 between photons, 0 a beam's; 2 more: to the back of a sheet
};
layout(std430) buffer WidePatches {
    WidePatch widePatchList[];
};

WidePatch packedPatch(Patch whole) {
    WidePatch made;
    for (int i = 0; i < 4; ++i) made.corners[i] = vec4(whole.corners[i], whole.densities[i]);
    made.normal = vec4(whole.side.normal, whole.first);
    made.direction = vec4(whole.side.direction, whole.tolerance);
    made.flux = vec4(whole.flux, (whole.isJoined ? 1.0 : 0.0) + (whole.side.isFromBehind ? 2.0 : 0.0));
    return made;
}

Patch unpackedPatch(WidePatch from) {
    Patch made;
    for (int i = 0; i < 4; ++i) {
        made.corners[i] = from.corners[i].xyz;
        made.densities[i] = from.corners[i].w;
    }
    made.side = PatchSide(from.normal.xyz, from.direction.xyz, from.flux.w >= 2.0);
    made.first = from.normal.w;
    made.tolerance = from.direction.w;
    made.flux = from.flux.rgb;
    made.isJoined = from.flux.w == 1.0 || from.flux.w == 3.0;
    made.narrowing = 1.0;
    return made;
}
