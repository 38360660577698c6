// SPDX-License-Identifier: MIT
// The last part of the reduce: the column of first hits becomes hits in the transfer map, or, for a
// photon that met nothing, an entry in the ledger. One thread a row.
#include "common/exit_test.glsl"
#include "common/ledger.glsl"
#include "screen_space_photons/row_extent.glsl"
#include "screen_space_photons/row_texel.glsl"

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2D hitPosition;
layout(rgba32f) uniform image2D hitSurface;
layout(rgba32f) uniform image2D hitFlux;
uniform sampler2D column;
uniform sampler2D photonPosition;
uniform sampler2D photonDirection;
uniform sampler2D photonFlux;
uniform int firstPhoton;
uniform int photonCount;
uniform int rowsWidth;

bool isFinite(vec3 v) {
    return !any(isnan(v)) && !any(isinf(v));
}

void main() {
    int row = int(gl_GlobalInvocationID.x);
    int index = firstPhoton + row;
    if (index >= photonCount || row >= textureSize(column, 0).y) return;
    ivec2 mapSize = textureSize(photonPosition, 0);
    ivec2 texel = ivec2(index % mapSize.x, index / mapSize.x);
    Photon photon =
        unpackPhoton(texelFetch(photonPosition, texel, 0), texelFetch(photonDirection, texel, 0),
                     texelFetch(photonFlux, texel, 0));
    if (photon.fate != kFateInFlight) return;  // its hit, if any, stands

    Hit hit = Hit(vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), kFateEnded);
    LayerHit first;
    int stepIndex;
    bool isExit;
    vec2 found = rowExtents[batch] > 0u ? texelFetch(column, ivec2(0, row), 0).xy : vec2(0.0);
    unpackRowTexel(found, first, stepIndex, isExit);
    bool isNumber = isFinite(photon.positionVs) && isFinite(photon.directionVs) &&
                    isFinite(photon.fluxWatts);
    if (!isNumber) {
        ledgerAdd(kAccountNotANumber, vec3(0.0));
    } else if (first.layer < 0) {
        ledgerAdd(clipRay(photon.positionVs, photon.directionVs).cause, photon.fluxWatts);
    } else {
        RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
        int steps = stepCount(segment, trace_lines_minimum, rowsWidth);
        ivec2 pixel = texelOfStep(segment, stepIndex, steps);
        vec4 surface = texelFetch(layerSurfaces, ivec3(pixel, first.layer), 0);
        hit.positionVs = photon.positionVs + first.t * photon.directionVs;
        hit.distanceMeters = first.t;
        vec2 depth = texelFetch(layerDepths, ivec3(pixel, first.layer), 0).xy;
        hit.material = uint(surface.w);
        vec3 triangle =
            unpackUnitVector(texelFetch(layerNormals, ivec3(pixel, first.layer), 0).xy);
        vec3 shading = isExit ? normalAtExit(hit.positionVs, pixel, first.layer)
                              : normalAtHit(hit.positionVs, surface, depth);
        bool arrives = isReceiver(materialKind(hit.material - 1u));
        hit.normalVs =
            arrives ? receiverNormal(hit.positionVs, photon.directionVs, shading, triangle)
                    : bendingNormal(photon.directionVs, shading, triangle, hit.material,
                                    photon.media);
        vec3 left = mediumTransmittance(innerMedium(photon.media), first.t);
        hit.fluxWatts = photon.fluxWatts * left;
        ledgerAdd(kAccountAbsorbed, photon.fluxWatts * (1.0 - left));
        hit.fate = arrives ? kFateReceiver : kFateSpecular;
        if (arrives) ledgerAdd(kAccountArrived, hit.fluxWatts);
    }
    imageStore(hitPosition, texel, hitPositionTexel(hit));
    imageStore(hitSurface, texel, hitSurfaceTexel(hit));
    imageStore(hitFlux, texel, hitFluxTexel(hit));
}
