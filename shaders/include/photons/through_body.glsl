// SPDX-License-Identifier: MIT
// A photon through a body: where it has entered, the view of the body's back faces says where it
// leaves (include/views/two_interfaces.glsl, W05). Whoever includes this includes the faces too.
#include "include/photons/interaction.glsl"
#include "include/views/two_interfaces.glsl"

// Where total reflection is booked: kAccountInternalReflectionLimit, or, in bodies that have none,
// kAccountAsPublished, where W05's estimates make it.
uniform uint totalReflectionAccount;

struct Passage {
    bool isOut;     // else it was totally reflected inside, and is in the ledger
    Photon photon;  // where it leaves, or, if it does not, where it has entered
    vec3 within;    // its direction inside, unit, eye view space
    vec2 indices;   // of refraction, outside and inside
    vec3 exitNormal;  // outward, unit, eye view space
    InnerPath way;    // in the view; of length 0 at the very rim
};

// `before`: as it came to `hit`; `inside`: as it goes on from there. `alongView`: it came as the
// view's ray does, so that what lies behind the front there is what it has before it.
Passage throughBody(Photon before, Hit hit, Photon inside, int steps, int distances,
                    bool alongView) {
    vec3 entry = pointFromEye(hit.positionVs);
    vec3 along = directionFromEye(before.directionVs);
    vec3 onward = directionFromEye(inside.directionVs);
    vec3 normal = directionFromEye(hit.normalVs);
    ivec2 there = texelAt(entry);
    float through = (backDepthAt(there) + entry.z) * length(viewRay(pixelOf(entry)));
    vec2 indices = indicesAt(hit.material, before.media, true);
    Passage passage = Passage(true, inside, inside.directionVs, indices, vec3(0.0),
                              InnerPath(0.0, entry, -normal, there));
    if (backDepthAt(there) > 0.0 && through > 0.0) {
        if (!alongView && steps > 0 && distances == kEstimates)
            through = distanceInside(entry, along, through, steps);
        passage.way = innerPath(entry, along, onward, normal, through, indices.y / indices.x, steps,
                                distances);
    } else {
        // At the very rim the back faces are another texel's: no thickness, it goes straight on.
        onward = along;
    }
    // The scene's medium is in bodies, too.
    vec3 left = transmittanceOver(tinted(view.mediumExtinction.rgb) + mediumAbsorption(hit.material),
                                  passage.way.lengthMeters);
    ledgerAdd(kAccountAbsorbed, inside.fluxWatts * (1.0 - left));
    inside.fluxWatts *= left;
    vec3 direction = directionToEye(onward);
    passage.exitNormal = directionToEye(passage.way.normal);
    if (passage.way.lengthMeters > 0.0) {
        Interface second = interactAt(direction, passage.exitNormal, indices.y, indices.x);
        if (second.reflectance >= 1.0 || dot(direction, passage.exitNormal) <= 0.0) {
            // What is totally reflected inside is not followed (WD08, section 6).
            ledgerAdd(totalReflectionAccount, inside.fluxWatts);
            passage.isOut = false;
            return passage;
        }
        ledgerAdd(kAccountUntracedBranch, inside.fluxWatts * second.reflectance);
        inside.fluxWatts *= 1.0 - second.reflectance;
        direction = second.refracted;
    }
    inside.positionVs = hit.positionVs + directionToEye(passage.way.exit - entry);
    inside.directionVs = direction;
    inside.media = leaveMedium(inside.media, hit.material);
    passage.photon = inside;
    return passage;
}

#ifdef PHOTON_BEAMS
// The shape of a face of the view in the eye's, where its normal is `normalVs`.
vec3 faceShapeToEye(ivec2 texel, int face, vec3 normalVs) {
    vec3 shape = faceShape(texel, face);
    mat2x3 tangents = basisAcross(faceNormal(texel, face));
    mat3x2 across = transpose(tangents);
    mat3 turning = tangents * (mat2(shape.x, shape.z, shape.z, shape.y) * across);
    mat3 toEye = transpose(mat3(view.fromEye));
    return shapeOf(normalVs, toEye * turning * transpose(toEye));
}

vec3 shapeAtExit(Passage passage) {
    if (!(passage.way.lengthMeters > 0.0)) return vec3(0.0);
    return faceShapeToEye(passage.way.texel, kBackFace, passage.exitNormal);
}

// The beam of a photon that has come through.
Beam beamThrough(Beam beam, Photon before, Hit hit, Passage passage) {
    beam = propagatedBeam(beam, before.directionVs, hit.distanceMeters, hit.normalVs, hit.shape,
                      passage.within, passage.indices.x / passage.indices.y);
    return propagatedBeam(beam, passage.within, passage.way.lengthMeters, passage.exitNormal,
                      shapeAtExit(passage), passage.photon.directionVs,
                      passage.indices.y / passage.indices.x);
}
#endif
