// SPDX-License-Identifier: MIT
// Both Fresnel branches of photons that have met a specular surface: one thread a texel of the map
// before, which is the lower half of the new one. There the transmitted branch goes on, or the only
// one; the reflected one begins a texel of the upper half. Without room for both, one is drawn by
// its share, and carries all of the flux.
#include "common/interaction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D photonPosition;
uniform sampler2D photonDirection;
uniform sampler2D photonFlux;
uniform sampler2D hitPosition;
uniform sampler2D hitSurface;
uniform sampler2D hitFlux;
layout(rgba32f) writeonly uniform image2D nextPosition;
layout(rgba32f) writeonly uniform image2D nextDirection;
layout(rgba32f) writeonly uniform image2D nextFlux;
layout(rgba32f) writeonly uniform image2D keptPosition;  // hits
layout(rgba32f) writeonly uniform image2D keptSurface;
layout(rgba32f) writeonly uniform image2D keptFlux;
uniform int isFirst;   // the photons come straight from the light
uniform int splits;    // the new map has an upper half
uniform uint drawing;  // tells one draw of branches from the next
uniform uint seedLow;
uniform uint seedHigh;

void store(ivec2 texel, Photon photon) {
    imageStore(nextPosition, texel, photonPositionTexel(photon));
    imageStore(nextDirection, texel, photonDirectionTexel(photon));
    imageStore(nextFlux, texel, photonFluxTexel(photon));
}
void keep(ivec2 texel, Hit hit) {
    imageStore(keptPosition, texel, hitPositionTexel(hit));
    imageStore(keptSurface, texel, hitSurfaceTexel(hit));
    imageStore(keptFlux, texel, hitFluxTexel(hit));
}

// A hash of a number (PCG, Jarzynski and Olano 2020).
uint hashOf(uint number) {
    uint state = number * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// [0, 1), from the seed, the draw and the texel.
float uniformAt(ivec2 texel) {
    uint number = hashOf(hashOf(seedLow) + seedHigh);
    number = hashOf(number + drawing);
    number = hashOf(number + uint(texel.x) + 65536u * uint(texel.y));
    return float(number >> 8u) / 16777216.0;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(hitFlux, 0);
    if (any(greaterThanEqual(texel, size))) return;
    Photon nobody = Photon(vec3(0.0), 0.0, vec3(0.0), kFateNone, vec3(0.0), 0u);
    Photon photon = unpackPhoton(texelFetch(photonPosition, texel, 0),
                                 texelFetch(photonDirection, texel, 0),
                                 texelFetch(photonFlux, texel, 0));
    Hit hit = unpackHit(texelFetch(hitPosition, texel, 0), texelFetch(hitSurface, texel, 0),
                        texelFetch(hitFlux, texel, 0));
    keep(texel, hit);
    ivec2 above = texel + ivec2(0, size.y);
    Branches branches = Branches(nobody, nobody);
    if (hit.fate == kFateSpecular) {
        if (isFirst != 0) ledgerAdd(kAccountEmitted, hit.fluxWatts);
        branches = branchesOf(photon, hit);
        photon = branches.transmitted;
        bool areBoth = photon.fate == kFateInFlight && branches.reflected.fate == kFateInFlight;
        if (photon.fate != kFateInFlight) photon = branches.reflected;
        if (areBoth && splits == 0) {
            vec3 whole = branches.transmitted.fluxWatts + branches.reflected.fluxWatts;
            float all = whole.r + whole.g + whole.b;
            vec3 part = branches.reflected.fluxWatts;
            float share = all > 0.0 ? (part.r + part.g + part.b) / all : 0.0;
            if (uniformAt(texel) < share) photon = branches.reflected;
            photon.fluxWatts = whole;
        }
        if (!areBoth) branches.reflected = nobody;
    } else if (photon.fate == kFateInFlight) {
        photon.fate = kFateEnded;
    }
    store(texel, photon);
    if (splits == 0) return;
    store(above, branches.reflected);
    keep(above, Hit(vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), kFateNone));
}
