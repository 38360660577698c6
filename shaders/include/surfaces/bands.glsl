// SPDX-License-Identifier: MIT
// The part of the spectrum that a shader's photon is of (scene/spectrum.h), in a scene with a
// dielectric that disperses (BANDS). Light of the eye's rays is of no band: it is bent as on the d
// line, and tinted by channels.
#include "framework/transport/types.h"

#ifdef BANDS
layout(std140) uniform Bands {
    BandTable bandTable;
};

float bandPlace = 0.0;
vec3 bandTint = vec3(0.0);  // adds up to 1; to 0 where there is no band
mat3 bandOfLight = mat3(1.0);

// That of a photon, by its light (PhotonOrigin).
void takeBandOf(uint light) {
    BandData band = bandTable.bands[light / uint(bandTable.lights.x)];
    bandPlace = band.tint.w;
    bandTint = band.tint.xyz;
    bandOfLight = mat3(band.ofLight[0].xyz, band.ofLight[1].xyz, band.ofLight[2].xyz);
}

// A light's number among those of its band.
uint lightOfBand(uint light) {
    return light % uint(bandTable.lights.x);
}

// What a colour does to the photon's flux, or adds to its extinction.
vec3 tinted(vec3 color) {
    return bandTint == vec3(0.0) ? color : vec3(dot(color, bandTint));
}

// The flux that a light of this linear Rec.709 sends in the band.
vec3 fluxOfBand(vec3 color) {
    return bandOfLight * color;
}

// Sums of flux as linear Rec.709, which may be negative in a channel.
vec3 rec709OfFlux(vec3 flux) {
    return mat3(bandTable.rec709FromFlux[0].xyz, bandTable.rec709FromFlux[1].xyz,
                bandTable.rec709FromFlux[2].xyz) *
           flux;
}

// What a surface sends on of a sum of flux that is of no one wavelength, as flux: by how much there
// is of each colour. Grey is exact.
vec3 reflectedFlux(vec3 flux, vec3 color) {
    vec3 amounts = max(rec709OfFlux(flux), vec3(0.0));
    float sum = amounts.r + amounts.g + amounts.b;
    return sum > 0.0 ? flux * (dot(color, amounts) / sum) : vec3(0.0);
}

float dispersedIndex(MaterialData material) {
    vec4 c = material.dispersion;
    return material.absorption.w +
           bandPlace * (c.x + bandPlace * (c.y + bandPlace * (c.z + bandPlace * c.w)));
}
#else
void takeBandOf(uint light) {}
uint lightOfBand(uint light) { return light; }
vec3 tinted(vec3 color) { return color; }
vec3 fluxOfBand(vec3 color) { return color; }
vec3 rec709OfFlux(vec3 flux) { return flux; }
vec3 reflectedFlux(vec3 flux, vec3 color) { return flux * color; }
float dispersedIndex(MaterialData material) { return material.absorption.w; }
#endif
