// SPDX-License-Identifier: MIT
// specular.two_interfaces: a photon that has entered a body leaves it where the light's view of its
// back faces says (include/two_interfaces.glsl). One thread a photon of one light.
#include "include/next_photons.glsl"
#include "include/lights.glsl"
#ifdef BODIES
#include "include/two_interfaces.glsl"
#endif

uniform int lightIndex;
#if defined(PHOTON_BEAMS) && defined(BODIES)
uniform sampler2D backShape;
#endif

#ifdef PHOTON_BEAMS
// How much a surface bends, on the average of all directions along it, 1/m: positive where the
// outside is convex (WD08, section 4.2, knows one curvature a pixel).
float meanCurvature(vec3 shape) { return 0.5 * (shape.x + shape.y); }

// A beam as round as WD08's: its width, m a cell, and how it grows, rad a cell. All of a photon's
// beam is in these two; nothing is divided by a distance that may vanish (hard cases 29, 30).
struct RoundBeam {
    float width;
    float growth;
};

Beam beamOf(RoundBeam round) { return Beam(mat2(round.width), mat2(round.growth)); }

// As the light sends it to `hit`: of the area that the photon's beam has there.
RoundBeam roundBeamAt(Beam beam, Photon photon, Hit hit) {
    float width = sqrt(abs(determinant(beam.place + hit.distanceMeters * beam.turn)));
    LightData light = lights[lightIndex];
    bool isParallel = uint(light.positionVs.w) == kLightDirectional;
    float vergence =
        isParallel ? 0.0 : 1.0 / max(distance(hit.positionVs, light.positionVs.xyz), 1e-20);
    return RoundBeam(width, width * vergence);
}

RoundBeam flown(RoundBeam round, float distance) {
    return RoundBeam(round.width + distance * round.growth, round.growth);
}

// Refracted by a surface of curvature `convex` towards where the light comes from.
RoundBeam refracted(RoundBeam round, float convex, float before, float beyond) {
    float power = (beyond - before) * convex;
    return RoundBeam(round.width, (before * round.growth - power * round.width) / beyond);
}

// Through a body: as a thin lens half-way (WD08, Eqs. 1 to 7, in vergences), or as a thick one, by
// both surfaces and the way between them.
RoundBeam throughLens(RoundBeam round, float front, float back, float thickness, float outside,
                      float inside) {
    if (specular_two_interfaces_lens == specular_two_interfaces_lens_thin) {
        RoundBeam middle = flown(round, 0.5 * thickness);
        float power = (inside - outside) / outside * (front + back);
        middle.growth -= power * middle.width;
        return flown(middle, 0.5 * thickness);
    }
    RoundBeam within = flown(refracted(round, front, outside, inside), thickness);
    return refracted(within, -back, inside, outside);
}

#ifdef BODIES
// The shape of the back faces in the eye's view, whose `normal` is given there.
vec3 backShapeAt(ivec2 texel, vec3 normalLs, vec3 normalVs) {
    vec3 shape = texelFetch(backShape, texel, 0).xyz;
    mat2x3 tangents = basisAcross(texelFetch(backSurface, texel, 0).xyz);
    mat3x2 across = transpose(tangents);
    mat3 turning = tangents * (mat2(shape.x, shape.z, shape.z, shape.y) * across);
    mat3 toEye = transpose(mat3(view.fromEye));
    return shapeOf(normalVs, toEye * turning * transpose(toEye));
}
#endif

// After one interaction alone: at a mirror, a sheet, or where all is reflected.
Beam beamAfterOne(ivec2 texel, Photon before, Hit hit, vec3 direction, bool isReflected) {
    Beam beam = beamAt(texel);
    if (specular_two_interfaces_lens == specular_two_interfaces_lens_beam)
        return beamOfBranch(beam, before, hit, direction, isReflected);
    RoundBeam round = roundBeamAt(beam, before, hit);
    bool enters = dot(before.directionVs, hit.normalVs) < 0.0;
    float convex = (enters ? 1.0 : -1.0) * meanCurvature(hit.shape);
    if (isReflected)
        return beamOf(RoundBeam(round.width, round.growth + 2.0 * convex * round.width));
    vec2 indices = indicesAt(hit.material, before.media, enters);
    return beamOf(refracted(round, convex, indices.x, indices.y));
}
#endif

void sendOnAfterOne(uint slot, ivec2 texel, Photon before, Hit hit, Photon branch,
                    PhotonOrigin origin) {
    storeNext(slot, branch, origin);
#ifdef PHOTON_BEAMS
    bool isReflected = (origin.path & 1u) == 1u;
    storeNextBeam(slot, beamAfterOne(texel, before, hit, branch.directionVs, isReflected));
#endif
}

// One that ends here, of which the ledger has the flux: the list has a place for it.
void sendNothing(uint slot, Photon photon, PhotonOrigin origin) {
    photon.fate = kFateEnded;
    photon.fluxWatts = vec3(0.0);
    storeNext(slot, photon, origin);
#ifdef PHOTON_BEAMS
    storeNextBeam(slot, Beam(mat2(0.0), mat2(0.0)));
#endif
}

#ifdef BODIES
// `inside`: the photon that has just entered; the light's view shows where it comes out.
void goThrough(uint slot, ivec2 texel, Photon before, Hit hit, Photon inside, PhotonOrigin origin) {
    vec3 entry = pointFromEye(hit.positionVs);
    vec3 along = directionFromEye(before.directionVs);
    vec3 onward = directionFromEye(inside.directionVs);
    vec3 normal = directionFromEye(hit.normalVs);
    ivec2 there = texelAt(entry);
    float through = (backAt(there) + entry.z) * length(viewRay(pixelOf(entry)));
    vec2 indices = indicesAt(hit.material, before.media, true);
    PhotonOrigin beyond = PhotonOrigin(origin.cell, origin.light, origin.path << 1, origin.parent);
    WayInside way = WayInside(0.0, entry, -normal, there);
    if (backAt(there) > 0.0 && through > 0.0) {
        way = wayInside(entry, along, onward, normal, through, indices.y / indices.x,
                        specular_two_interfaces_steps, specular_two_interfaces_distance);
    } else {
        // At the very rim the back faces are another texel's: no thickness, and it goes straight on.
        onward = along;
    }
    vec3 left = mediumTransmittance(hit.material, way.length);
    ledgerAdd(kAccountAbsorbed, inside.fluxWatts * (1.0 - left));
    inside.fluxWatts *= left;
    vec3 direction = directionToEye(onward);
    vec3 exitNormal = directionToEye(way.normal);
    if (way.length > 0.0) {
        Interface second = interactAt(direction, exitNormal, indices.y, indices.x);
        if (second.reflectance >= 1.0 || dot(direction, exitNormal) <= 0.0) {
            // What is totally reflected inside is not followed (WD08, section 6).
            ledgerAdd(kAccountInternalReflectionLimit, inside.fluxWatts);
            sendNothing(slot, inside, beyond);
            return;
        }
        ledgerAdd(kAccountUntracedBranch, inside.fluxWatts * second.reflectance);
        inside.fluxWatts *= 1.0 - second.reflectance;
        direction = second.refracted;
    }
    vec3 within = inside.directionVs;
    inside.positionVs = hit.positionVs + directionToEye(way.exit - entry);
    inside.directionVs = direction;
    inside.media = leaveMedium(inside.media, hit.material);
    storeNext(slot, inside, beyond);
#ifdef PHOTON_BEAMS
    vec3 backs = way.length > 0.0 ? backShapeAt(way.texel, way.normal, exitNormal) : vec3(0.0);
    Beam beam = beamAt(texel);
    if (specular_two_interfaces_lens == specular_two_interfaces_lens_beam) {
        beam = beamBeyond(beam, before.directionVs, hit.distanceMeters, hit.normalVs, hit.shape,
                          within, indices.x / indices.y);
        beam = beamBeyond(beam, within, way.length, exitNormal, backs, direction,
                          indices.y / indices.x);
    } else {
        beam = beamOf(throughLens(roundBeamAt(beam, before, hit), meanCurvature(hit.shape),
                                  meanCurvature(backs), way.length, indices.x, indices.y));
    }
    storeNextBeam(slot, beam);
#endif
}
#endif

void main() {
    uint index = photonOfThread();
    ivec2 texel = ivec2(photonTexel(photons, index));
    bool goesOn = index < photons.count &&
                  uint(texelFetch(hitFlux, texel, 0).w) == kFateSpecular;
    uint slot = nextSlot(goesOn);
    if (!goesOn) return;
    PhotonOrigin origin = originAt(texel);
    if (int(origin.light) != lightIndex) return;
    Hit hit = hitAt(texel);
    Photon photon = photonAt(texel);
    if (origin.path != kEmittedPath) {
        // The light's view says nothing of light that has been bent already.
        ledgerAdd(kAccountBounceLimit, hit.fluxWatts);
        sendNothing(slot, photon, originOfNext(origin, index, false));
        return;
    }
    ledgerAdd(kAccountEmitted, hit.fluxWatts);
    Branches branches = branchesOf(photon, hit);
    bool refracts = branches.transmitted.fate == kFateInFlight;
    bool reflects = branches.reflected.fate == kFateInFlight;
    if (refracts && reflects) {
        bool wantsReflected =
            specular_two_interfaces_branch == specular_two_interfaces_branch_reflected;
        ledgerAdd(kAccountUntracedBranch,
                  (wantsReflected ? branches.transmitted : branches.reflected).fluxWatts);
        refracts = !wantsReflected;
    }
    if (!refracts) {
        if (!reflects) {
            // It was in more dielectrics than a stack holds.
            sendNothing(slot, branches.reflected, originOfNext(origin, index, false));
            return;
        }
        sendOnAfterOne(slot, texel, photon, hit, branches.reflected,
                       originOfNext(origin, index, true));
        return;
    }
    PhotonOrigin entered = originOfNext(origin, index, false);
#ifdef BODIES
    bool entersBody =
        !isOpen(hit.material - 1u) && dot(photon.directionVs, hit.normalVs) < 0.0;
    if (entersBody) {
        goThrough(slot, texel, photon, hit, branches.transmitted, entered);
        return;
    }
#endif
    sendOnAfterOne(slot, texel, photon, hit, branches.transmitted, entered);
}
