// SPDX-License-Identifier: MIT
// specular.deferred: a photon goes through one body after the other, of each by the fronts and
// backs that its light sees of it (WN09, section 3.1.1). One thread a photon of one light.
#include "include/first_interaction.glsl"
#include "include/lights.glsl"
#ifdef BODIES
#include "adaptive_caustic_map/bodies.glsl"
#include "include/deliver.glsl"
#include "include/through_body.glsl"

// A photon on its way to or out of a body.
struct Traveller {
    Photon photon;
    uint path;  // as PhotonOrigin's
    bool isEnded;
#ifdef PHOTON_BEAMS
    Beam beam;
#endif
};

#ifdef PHOTON_BEAMS
// The same offsets, in the basis across another direction.
Beam seenAlong(Beam beam, vec3 from, vec3 to) {
    mat2 turning = transpose(basisAcross(to)) * basisAcross(from);
    return Beam(turning * beam.place, turning * beam.turn);
}
#endif

// A photon that has come to a body's front.
struct Entrance {
    int body;
    Photon before;  // as it came
    Hit hit;
    bool isUnbent;  // as light that was never bent
    Photon inside;  // as it goes on
};

#ifdef SEVERAL_BODIES
// From where it has left a body to the next one that is not among those of `met`. False: it goes on
// as `at` says, past all of them or reflected at the last.
bool meetsNext(inout Traveller at, inout Entrance entrance, uint met) {
    PlaneSearch how = PlaneSearch(specular_deferred_iterations, false, specular_deferred_looks,
                                  specular_deferred_refinements);
    Meeting next = nextBody(pointFromEye(at.photon.positionVs),
                            directionFromEye(at.photon.directionVs), met, how);
    if (next.body < 0) return false;
    bodyAsked = next.body;
    vec3 normal = directionToEye(next.normal);
    Photon arriving = at.photon;
    Hit hit = deliverTo(arriving, next.t, normal, normal, next.material);
    // "The refractor is treated as if viewed from" the light, where that sees what was met.
    vec3 unbent = lightDirection(lights[lightIndex], hit.positionVs);
    bool isUnbent = specular_deferred_incidence == specular_deferred_incidence_light &&
                    dot(unbent, hit.normalVs) < 0.0;
    if (isUnbent) arriving.directionVs = unbent;
#ifdef PHOTON_BEAMS
    hit.shape = faceShapeToEye(next.texel, kFrontFace, hit.normalVs);
    if (isUnbent) {
        at.beam.place += next.t * at.beam.turn;
        at.beam = seenAlong(at.beam, at.photon.directionVs, arriving.directionVs);
        hit.distanceMeters = 0.0;
    }
#endif
    TakenBranch taken = branchTaken(arriving, hit, false);
    at.path = (at.path << 1) | uint(taken.isReflected);
    entrance = Entrance(next.body, arriving, hit, isUnbent, taken.photon);
    if (!taken.isReflected) return true;
#ifdef PHOTON_BEAMS
    at.beam = beamOfBranch(at.beam, arriving, hit, taken.photon.directionVs, true);
#endif
    at.isEnded = taken.photon.fate != kFateInFlight;
    at.photon = taken.photon;
    return false;
}
#endif

// From body to body, the first of which it has just entered.
Traveller goThrough(Traveller at, Entrance entrance) {
    uint met = 0u;
    for (int i = 0; i < bodyCount; ++i) {
        met |= 1u << uint(entrance.body);
        bodyAsked = entrance.body;
        Passage passage =
            throughBody(entrance.before, entrance.hit, entrance.inside, specular_deferred_steps,
                        specular_deferred_distance, entrance.isUnbent);
        at.path <<= 1;
        at.isEnded = !passage.isOut;
        at.photon = passage.photon;
#ifdef PHOTON_BEAMS
        if (passage.isOut)
            at.beam = beamThrough(at.beam, entrance.before, entrance.hit, passage);
#endif
#ifdef SEVERAL_BODIES
        if (at.isEnded || i + 1 == bodyCount || !meetsNext(at, entrance, met)) break;
#endif
    }
    return at;
}
#endif

void main() {
    Arrival arrival;
    if (!arrivalOfThread(arrival)) return;
    TakenBranch taken = branchTaken(arrival.photon, arrival.hit, false);
    PhotonOrigin origin = originOfNext(arrival.origin, arrival.index, taken.isReflected);
    if (taken.photon.fate != kFateInFlight) {
        sendNothing(arrival.slot, taken.photon,
                    originOfNext(arrival.origin, arrival.index, false));
        return;
    }
#ifdef BODIES
    if (!taken.isReflected && entersBody(arrival.photon, arrival.hit)) {
        int body = bodyAround(pointFromEye(arrival.hit.positionVs));
        if (body < 0) {
            // One of those beyond specular.deferred.layers.
            ledgerAdd(kAccountBounceLimit, taken.photon.fluxWatts);
            sendNothing(arrival.slot, taken.photon, origin);
            return;
        }
        Traveller at;
        at.photon = arrival.photon;
        at.path = origin.path;
        at.isEnded = false;
#ifdef PHOTON_BEAMS
        at.beam = beamAt(arrival.texel);
#endif
        at = goThrough(at, Entrance(body, arrival.photon, arrival.hit, true, taken.photon));
        origin.path = at.path;
        if (at.isEnded) {
            sendNothing(arrival.slot, at.photon, origin);
            return;
        }
        storeNext(arrival.slot, at.photon, origin);
#ifdef PHOTON_BEAMS
        storeNextBeam(arrival.slot, at.beam);
#endif
        return;
    }
#endif
    sendOn(arrival.slot, arrival.texel, arrival.photon, arrival.hit, taken.photon, origin);
}
