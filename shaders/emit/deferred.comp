// SPDX-License-Identifier: MIT
// emit.deferred: a photon a cell, where the light's ray through its middle first meets something
// specular, with the flux that the light sends through the cell (WN09, section 3.2). One thread a
// photon of one light.
#include "include/photons/next_photon_thread.glsl"
#include "include/photons/store_photons.glsl"
#include "emit/deferred_cell.glsl"
#include "include/photons/neighbour_batch.glsl"
#include "include/surfaces/specular.glsl"
#define HITS_WITHOUT_SHAPE
#include "include/photons/store_hits.glsl"
// OpenGL grants a shader no more than eight storage blocks, of which a list of cells is one.
#ifndef CELL_LIST
#include "include/photons/ledger.glsl"
#endif

uniform ivec2 ownRows;

// Of a square of the light's view. `reach`: how far it is to the surface, m.
vec3 fluxOf(LightData light, vec2 ndc, vec2 size, float reach, float transmittance) {
    vec2 across = size * extentOfCells();
#ifdef ORTHOGRAPHIC_VIEW
    return light.power.rgb * (across.x * across.y);
#else
    vec2 place = placeOf(ndc);
    float cosine = inversesqrt(1.0 + dot(place, place));
    vec3 direction = directionToEye(vec3(place, -1.0) * cosine);
    vec3 there = light.positionVs.xyz + direction * reach;
    return lightIntensity(light, there, max(across.x, across.y)) *
           (across.x * across.y * cosine * cosine * cosine * transmittance);
#endif
}

void store(uint index, ivec2 texel, CellOfLight cell, Photon photon, vec3 normal, uint material) {
    storeNext(index, photon, PhotonOrigin(cell.number, uint(lightIndex), kEmittedPath, 0u, 0u));
    storeHit(texel, Hit(photon.positionVs, 0.0, normal, material, photon.fluxWatts, photon.fate,
                        vec3(0.0)));
}

void main() {
    uint index = photonOfThread();
    if (index >= nextPhotons.count) return;
    ivec2 texel = ivec2(photonTexel(nextPhotons, index));
#ifndef CELL_LIST
    uint perLight = uint(gridSize.x * rowsHere);
    if (int(index / perLight) + firstLight != lightIndex) return;
    CellOfLight cell = cellOfPhoton(index % perLight);
#else
    CellOfLight cell = cellOfPhoton(index);
    if (!cell.isOwn) return;
#endif
    Photon photon = Photon(vec3(0.0), 0.0, vec3(0.0), kFateNone, vec3(0.0), 0u);
    DeferredPoint point = pointOfCell(cell, emit_deferred_lookup == emit_deferred_lookup_triangle);
    if (point.material == 0u || isReceiver(materialKind(point.material - 1u))) {
        store(index, texel, cell, photon, vec3(0.0), 0u);
        return;
    }
    takeBandOf(uint(lightIndex));
    LightData light = lights[lightIndex];
    vec3 direction = lightDirection(light, point.position);
    vec3 geometric = point.geometric == vec3(0.0) ? -direction : point.geometric;
    // A light whose rays first hit a dielectric from within is inside of it.
    bool isInside = materialKind(point.material - 1u) == kMaterialDielectric &&
                    dot(direction, geometric) > 0.0;
    uint media = isInside ? enterMedium(0u, point.material) : 0u;
    float reach = kIsParallel ? 0.0 : distance(point.position, light.positionVs.xyz);
    vec3 left = mediumTransmittance(innerMedium(media), reach);
    vec3 flux = vec3(0.0);
    if (cell.quarters == 0u) flux = fluxOf(light, cell.middle, cell.size, reach, 1.0);
    // Of the quarters as they would have been: what they add up to is exact.
    for (int i = 0; i < 4 && cell.quarters != 0u; ++i) {
        if ((cell.quarters & (1u << i)) != 0u)
            flux += fluxOf(light, quarterOf(cell, i), 0.5 * cell.size, reach, 1.0);
    }
    flux = fluxOfBand(flux * left);
#ifndef CELL_LIST
    int row = int((index % perLight) / uint(gridSize.x)) + firstRow;
    if (row < ownRows.x || row >= ownRows.y) flux *= kNegligible;
#endif
    if (!(flux.r + flux.g + flux.b > 0.0)) {
        store(index, texel, cell, photon, vec3(0.0), 0u);
        return;
    }
    vec2 across = cell.size * extentOfCells();
    vec2 place = placeOf(cell.middle);
    float side = sqrt(across.x * across.y);
    float footprint =
        kIsParallel ? side : side * reach * pow(1.0 + dot(place, place), -0.75);
    vec3 shading = shadingNormal(point.normal, geometric);
    vec3 normal = bendingNormal(direction, shading, geometric, point.material, media);
#ifndef CELL_LIST
    if (normal != shading) ledgerAdd(kAccountTriangleNormal, flux);
#endif
    photon = Photon(point.position, footprint, direction, kFateSpecular, flux, media);
    store(index, texel, cell, photon, normal, point.material);
}
