// SPDX-License-Identifier: MIT
// specular.deferred: a photon goes through one body after the other, of each by the fronts and
// backs that its light sees of it (WN09, section 3.1.1). One thread a photon of one light.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/first_interaction.glsl"
#include "include/photons/lights.glsl"
#ifdef BODIES
#include "deferred_buffers/bodies.glsl"
#include "include/photons/deliver.glsl"
#include "include/photons/through_body.glsl"

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
    Beam turned = beamFromPoint(turning * beam.place, turning * beam.turn);
#ifdef LIGHT_SPREAD
    turned.spreadPlace = turning * beam.spreadPlace;
    turned.spreadTurn = turning * beam.spreadTurn;
#endif
    return turned;
}
#endif

// A photon that has come to a body's front.
struct Entrance {
    int body;
    Photon before;  // as it came
    Hit hit;
    bool isUnrefracted;  // as light that was never bent
    Photon inside;  // as it goes on
};

#ifdef SEVERAL_BODIES
// From where it has left a body to the next one that is not among those of `visited`. False: it goes on
// as `at` says, past all of them or reflected at the last.
bool findNextBody(inout Traveller at, inout Entrance entrance, uint visited) {
    PlaneSearch how = PlaneSearch(specular_deferred_iterations, false, specular_deferred_search_steps,
                                  specular_deferred_refinements);
    BodyHit next = nextBody(pointFromEye(at.photon.positionVs),
                            directionFromEye(at.photon.directionVs), visited, how);
    if (next.body < 0) return false;
    bodyIndex = next.body;
    vec3 normal = directionToEye(next.normal);
    Photon arriving = at.photon;
    Hit hit = deliverTo(arriving, next.t, normal, normal, next.material);
    // "The refractor is treated as if viewed from" the light, where that sees what was met.
    vec3 unbent = lightDirection(lights[lightIndex], hit.positionVs);
    bool isUnrefracted = specular_deferred_incidence == specular_deferred_incidence_light &&
                    dot(unbent, hit.normalVs) < 0.0;
    if (isUnrefracted) arriving.directionVs = unbent;
#ifdef PHOTON_BEAMS
    hit.shape = faceShapeToEye(next.texel, kFrontFace, hit.normalVs);
    if (isUnrefracted) {
        at.beam.place += next.t * at.beam.turn;
        at.beam = seenAlong(at.beam, at.photon.directionVs, arriving.directionVs);
        hit.distanceMeters = 0.0;
    }
#endif
    ChosenBranch taken = chosenBranch(arriving, hit, false);
    at.path = (at.path << 1) | uint(taken.isReflected);
    entrance = Entrance(next.body, arriving, hit, isUnrefracted, taken.photon);
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
    uint visited = 0u;
    for (int i = 0; i < bodyCount; ++i) {
        visited |= 1u << uint(entrance.body);
        bodyIndex = entrance.body;
        Passage passage =
            throughBody(entrance.before, entrance.hit, entrance.inside, specular_deferred_steps,
                        specular_deferred_distance, entrance.isUnrefracted);
        at.path <<= 1;
        at.isEnded = !passage.isOut;
        at.photon = passage.photon;
#ifdef PHOTON_BEAMS
        if (passage.isOut)
            at.beam = beamThrough(at.beam, entrance.before, entrance.hit, passage);
#endif
#ifdef SEVERAL_BODIES
        if (at.isEnded || i + 1 == bodyCount || !findNextBody(at, entrance, visited)) break;
#endif
    }
    return at;
}
#endif

void threadMain() {
    Arrival arrival;
    if (!arrivalOfThread(arrival)) return;
    ChosenBranch taken = chosenBranch(arrival.photon, arrival.hit, false);
    PhotonOrigin origin = nextPhotonOrigin(arrival.origin, arrival.index, taken.isReflected);
    if (taken.photon.fate != kFateInFlight) {
        sendNothing(arrival.slot, taken.photon,
                    nextPhotonOrigin(arrival.origin, arrival.index, false));
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
    emitNext(arrival.slot, arrival.texel, arrival.photon, arrival.hit, taken.photon, origin);
}
