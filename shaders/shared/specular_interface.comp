// SPDX-License-Identifier: MIT
// What photons do where they have met a specular surface: one thread a photon.
#include "common/interaction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2D photonPosition;
layout(rgba32f) uniform image2D photonDirection;
layout(rgba32f) uniform image2D photonFlux;
uniform sampler2D hitPosition;
uniform sampler2D hitSurface;
uniform sampler2D hitFlux;
uniform int isFirst;  // the photons come straight from the light

void store(ivec2 texel, Photon photon) {
    imageStore(photonPosition, texel, photonPositionTexel(photon));
    imageStore(photonDirection, texel, photonDirectionTexel(photon));
    imageStore(photonFlux, texel, photonFluxTexel(photon));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, textureSize(hitFlux, 0)))) return;
    Photon photon = unpackPhoton(imageLoad(photonPosition, texel),
                                 imageLoad(photonDirection, texel), imageLoad(photonFlux, texel));
    Hit hit = unpackHit(texelFetch(hitPosition, texel, 0), texelFetch(hitSurface, texel, 0),
                        texelFetch(hitFlux, texel, 0));
    if (hit.fate != kFateSpecular) {
        if (photon.fate == kFateInFlight) {
            photon.fate = kFateEnded;
            store(texel, photon);
        }
        return;
    }
    if (isFirst != 0) ledgerAdd(kAccountEmitted, hit.fluxWatts);

    Branches branches = branchesOf(photon, hit);
    bool goesThrough = branches.transmitted.fate == kFateInFlight;
    if (goesThrough && branches.reflected.fate == kFateInFlight)
        ledgerAdd(kAccountUntracedBranch, branches.reflected.fluxWatts);
    store(texel, goesThrough ? branches.transmitted : branches.reflected);
}
