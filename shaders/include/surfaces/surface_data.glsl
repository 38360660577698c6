// SPDX-License-Identifier: MIT
// Materials for shaders that are no fragments (include/surfaces/surface.glsl needs derivatives).
#include "include/surfaces/bands.glsl"
#include "framework/transport/types.h"

layout(std430) readonly buffer Materials {
    MaterialData materials[];
};

uint materialKind(uint material) {
    return uint(materials[material].albedo.w);
}

// Light ends on a receiver; it goes on from every other surface.
bool isReceiver(uint kind) {
    return kind == kMaterialLambertian || kind == kMaterialGlossy;
}

// Whether the surface bounds no volume: a sheet.
bool isOpen(uint material) {
    return materials[material].uv.w > 0.0;
}

// Index of refraction of a medium: material index + 1, or 0 for vacuum.
float mediumIndex(uint medium) {
    return medium == 0u ? 1.0 : dispersedIndex(materials[medium - 1u]);
}

// Share of the flux that is left after a path (Beer-Lambert). Zero length or zero extinction leave
// all of it, whatever the other is: infinite for a black tint.
vec3 transmittanceOver(vec3 extinctionPerMeter, float distanceMeters) {
    vec3 depth = extinctionPerMeter * distanceMeters;
    return exp(-mix(vec3(0.0), depth, greaterThan(depth, vec3(0.0))));
}

// What a dielectric absorbs, 1/m.
vec3 mediumAbsorption(uint medium) {
    return medium == 0u ? vec3(0.0) : tinted(materials[medium - 1u].absorption.rgb);
}

// The share that a path through a dielectric leaves.
vec3 mediumTransmittance(uint medium, float distanceMeters) {
    return transmittanceOver(mediumAbsorption(medium), distanceMeters);
}

// The interpolated normal, unit, and never on the other side of the surface than the geometric one:
// the side of a surface is the triangle's (hard case 26).
vec3 shadingNormal(vec3 interpolated, vec3 geometric) {
    float size = length(interpolated);
    if (!(size > 1e-12)) return geometric;
    vec3 n = interpolated / size;
    float side = dot(n, geometric);
    return side > 0.0 ? n : normalize(n + (1e-3 - side) * geometric);
}
