// SPDX-License-Identifier: MIT
// What photons do where they have met a specular surface: one thread a photon.
#include "common/ledger.glsl"
#include "common/specular.glsl"

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
    Photon photon = unpackPhoton(imageLoad(photonPosition, texel), imageLoad(photonDirection, texel),
                                 imageLoad(photonFlux, texel));
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

    uint surface = hit.material - 1u;
    MaterialData data = materials[surface];
    photon.positionVs = hit.positionVs;
    photon.fluxWatts = hit.fluxWatts;
    photon.fate = kFateInFlight;
    // The hit's normal has the triangle's side: see bendingNormal.
    bool enters = dot(photon.directionVs, hit.normalVs) < 0.0;
    photon.media = withLeftSide(photon.media, kLeftNothing);
    if (uint(data.albedo.w) == kMaterialMirror) {
        photon.directionVs = normalize(reflect(photon.directionVs, hit.normalVs));
        ledgerAdd(kAccountAbsorbed, photon.fluxWatts * (1.0 - data.albedo.rgb));
        photon.fluxWatts *= data.albedo.rgb;
        if (isOpen(surface)) {
            photon.media = withLeftSide(photon.media, enters ? kLeftOutside : kLeftInside);
        }
    } else {
        vec2 indices = indicesAt(hit.material, photon.media, enters);
        Interface meeting = interactAt(photon.directionVs, hit.normalVs, indices.x, indices.y);
        if (meeting.reflectance >= 1.0) {
            photon.directionVs = meeting.reflected;
        } else {
            photon.directionVs = meeting.refracted;
            photon.media = enters ? enterMedium(photon.media, hit.material)
                                  : leaveMedium(photon.media);
            ledgerAdd(kAccountUntracedBranch, photon.fluxWatts * meeting.reflectance);
            photon.fluxWatts *= 1.0 - meeting.reflectance;
        }
    }
    store(texel, photon);
}
