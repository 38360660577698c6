// SPDX-License-Identifier: MIT
// specular.two_interfaces: a photon that has entered a body leaves it where the light's view of its
// back faces says (include/views/two_interfaces.glsl). One thread a photon of one light.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/first_interaction.glsl"
#include "include/photons/lights.glsl"
#ifdef BODIES
#include "include/views/back_faces.glsl"
#include "include/photons/through_body.glsl"
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

Beam beamOf(RoundBeam round) { return beamFromPoint(mat2(round.width), mat2(round.growth)); }

// As the light sends it to `hit`: of the area that the photon's beam has there.
RoundBeam roundBeamAt(Beam beam, Photon photon, Hit hit) {
    float width = sqrt(abs(determinant(beam.place + hit.distanceMeters * beam.turn)));
    LightData light = lights[lightIndex];
    bool isParallel = uint(light.positionVs.w) == kLightDirectional;
    float vergence =
        isParallel ? 0.0 : 1.0 / max(distance(hit.positionVs, light.positionVs.xyz), 1e-20);
    return RoundBeam(width, width * vergence);
}

RoundBeam propagated(RoundBeam round, float distance) {
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
        RoundBeam middle = propagated(round, 0.5 * thickness);
        float power = (inside - outside) / outside * (front + back);
        middle.growth -= power * middle.width;
        return propagated(middle, 0.5 * thickness);
    }
    RoundBeam within = propagated(refracted(round, front, outside, inside), thickness);
    return refracted(within, -back, inside, outside);
}

RoundBeam roundBeamAfter(Beam beam, Photon before, Hit hit, bool isReflected) {
    RoundBeam round = roundBeamAt(beam, before, hit);
    bool enters = dot(before.directionVs, hit.normalVs) < 0.0;
    float convex = (enters ? 1.0 : -1.0) * meanCurvature(hit.shape);
    if (isReflected) return RoundBeam(round.width, round.growth + 2.0 * convex * round.width);
    vec2 indices = indicesAt(hit.material, before.media, enters);
    return refracted(round, convex, indices.x, indices.y);
}

// After one interaction alone: at a mirror, a sheet, or where all is reflected.
Beam beamAfterInteraction(ivec2 texel, Photon before, Hit hit, vec3 direction, bool isReflected) {
    Beam beam = beamAt(texel);
    if (specular_two_interfaces_lens == specular_two_interfaces_lens_beam)
        return beamOfBranch(beam, before, hit, direction, isReflected);
    Beam round = beamOf(roundBeamAfter(beam, before, hit, isReflected));
#ifdef LIGHT_SPREAD
    round = withSpreadOf(round, beamOfBranch(beam, before, hit, direction, isReflected));
#endif
    return round;
}
#endif

void emitNextAfterOne(Arrival arrival, Photon branch, PhotonOrigin origin) {
    storeNext(arrival.slot, branch, origin);
#ifdef PHOTON_BEAMS
    bool isReflected = (origin.path & 1u) == 1u;
    storeNextBeam(arrival.slot, beamAfterInteraction(arrival.texel, arrival.photon, arrival.hit,
                                             branch.directionVs, isReflected));
#endif
}

#ifdef BODIES
// `inside`: the photon that has just entered; the light's view shows where it comes out.
void goThrough(Arrival arrival, Photon inside, PhotonOrigin origin) {
    Passage passage =
        throughBody(arrival.photon, arrival.hit, inside, specular_two_interfaces_steps,
                    specular_two_interfaces_distance, true);
    PhotonOrigin beyond = origin;
    beyond.path <<= 1;
    if (!passage.isOut) {
        sendNothing(arrival.slot, passage.photon, beyond);
        return;
    }
    storeNext(arrival.slot, passage.photon, beyond);
#ifdef PHOTON_BEAMS
    Beam beam = beamAt(arrival.texel);
    if (specular_two_interfaces_lens == specular_two_interfaces_lens_beam) {
        beam = beamThrough(beam, arrival.photon, arrival.hit, passage);
    } else {
        Beam round = beamOf(throughLens(roundBeamAt(beam, arrival.photon, arrival.hit),
                                        meanCurvature(arrival.hit.shape),
                                        meanCurvature(shapeAtExit(passage)),
                                        passage.way.lengthMeters, passage.indices.x,
                                        passage.indices.y));
#ifdef LIGHT_SPREAD
        round = withSpreadOf(round, beamThrough(beam, arrival.photon, arrival.hit, passage));
#endif
        beam = round;
    }
    storeNextBeam(arrival.slot, beam);
#endif
}
#endif

void threadMain() {
    Arrival arrival;
    if (!arrivalOfThread(arrival)) return;
    ChosenBranch taken = chosenBranch(
        arrival.photon, arrival.hit,
        specular_two_interfaces_branch == specular_two_interfaces_branch_reflected);
    PhotonOrigin origin = nextPhotonOrigin(arrival.origin, arrival.index, taken.isReflected);
    if (taken.photon.fate != kFateInFlight) {
        sendNothing(arrival.slot, taken.photon,
                    nextPhotonOrigin(arrival.origin, arrival.index, false));
        return;
    }
#ifdef BODIES
    if (!taken.isReflected && entersBody(arrival.photon, arrival.hit)) {
        goThrough(arrival, taken.photon, origin);
        return;
    }
#endif
    emitNextAfterOne(arrival, taken.photon, origin);
}
