// SPDX-License-Identifier: MIT
// Where a photon arrives, and by its beam where its neighbours would.
#include "include/hits.glsl"
#include "include/ledger_unit.glsl"
#include "include/photon_thread.glsl"
#include "include/view.glsl"

// A beam that grazes is taken as if it came at this sine at least, which bounds what it covers.
const float kLeastArrivalSlant = 0.01;

struct Arrival {
    vec3 position;  // of the view, m
    vec3 normal;    // unit, outward
    vec3 direction;
    mat2x3 beside;  // to where the next cells' light arrives, along u and v, m
    vec2 farther;   // than this light flies, m
    float distance;
    vec3 flux;      // W
    float density;  // the flux by what a cell covers, W/m²
    uint material;  // index + 1
    uint path;
};

mat2x3 fromEye(mat2x3 offsets) {
    return mat2x3(directionFromEye(offsets[0]), directionFromEye(offsets[1]));
}

// Whether another batch of emission brings a photon as well, and here it is only to be joined with
// (shared/emit_grid.frag).
bool isOfOtherBatch(vec3 flux) {
    return (flux.r + flux.g + flux.b) * ledgerUnitsPerWatt < 0.25;
}

// Of all channels, in whichever batch it is.
float wholeFlux(vec3 flux) {
    return (flux.r + flux.g + flux.b) * (isOfOtherBatch(flux) ? exp2(80.0) : 1.0);
}

Arrival arrivalOf(ivec2 texel) {
    Hit hit = hitAt(texel);
    Photon photon = photonAt(texel);
    vec2 farther;
    mat2x3 beside = beamOnPlane(beamAt(texel), photon.directionVs, hit.distanceMeters, hit.normalVs,
                                kLeastArrivalSlant, farther);
    float area = length(cross(beside[0], beside[1]));
    return Arrival(pointFromEye(hit.positionVs), directionFromEye(hit.normalVs),
                   directionFromEye(photon.directionVs), fromEye(beside), farther,
                   hit.distanceMeters, hit.fluxWatts, wholeFlux(hit.fluxWatts) / max(area, 1e-30),
                   hit.material, originAt(texel).path);
}

// How far a beam goes on towards a corner of its cell, as shares of the way along u and v, before it
// would arrive where it has come from: light that enters water beside a wall lights none of the wall
// above it.
vec2 reachTowards(Arrival at, vec2 corner) {
    vec2 less = max(-at.farther * corner, 0.0);
    float all = less.x + less.y;
    if (all <= at.distance || at.distance <= 0.0) return vec2(1.0);
    bool isFirst = less.x > less.y;
    float more = max(less.x, less.y);
    float left = at.distance - min(less.x, less.y);
    if (left <= 0.0) return vec2(at.distance / all);
    return isFirst ? vec2(left / more, 1.0) : vec2(1.0, left / more);
}

// The share that is left of a quarter of a cell, by its corner: right, up: bits.
float quarterShare(Arrival at, uint quarter) {
    vec2 corner = vec2(quarter & 1u, quarter >> 1u) - 0.5;
    vec2 along = vec2(corner.x, 0.0);
    vec2 up = vec2(0.0, corner.y);
    vec2 a = along * reachTowards(at, along);
    vec2 b = corner * reachTowards(at, corner);
    vec2 c = up * reachTowards(at, up);
    float twice = (a.x * b.y - a.y * b.x) + (b.x * c.y - b.y * c.x);
    return 2.0 * abs(twice);
}
