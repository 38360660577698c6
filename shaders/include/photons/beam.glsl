// SPDX-License-Identifier: MIT
// Beams: how a photon's ray changes with its place in its light's grid, to first order (ray
// differentials, Igehy 1999), through flight, refraction and reflection at curved surfaces.

// Two unit vectors at right angles to a unit vector and to each other (Duff et al. 2017, "Building
// an Orthonormal Basis, Revisited"): the same for the same bits of it.
mat2x3 basisAcross(vec3 unit) {
    float side = unit.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + unit.z);
    float b = unit.x * unit.y * a;
    return mat2x3(vec3(1.0 + side * unit.x * unit.x * a, side * b, -side * unit.x),
                  vec3(b, side + unit.y * unit.y * a, -unit.y));
}

// What the next cell along u (first column) and along v (second) has otherwise, in the basis across
// the photon's direction.
struct Beam {
    mat2 place;  // m a cell, where the two rays are side by side
    mat2 turn;   // of the direction, rad a cell
#ifdef LIGHT_SPREAD
    // What light from two places on the edge of the disc that its light stands for has otherwise:
    // as above, m and rad.
    mat2 spreadPlace;
    mat2 spreadTurn;
#endif
};

// Of light from a point.
Beam beamFromPoint(mat2 place, mat2 turn) {
#ifdef LIGHT_SPREAD
    return Beam(place, turn, mat2(0.0), mat2(0.0));
#else
    return Beam(place, turn);
#endif
}

Beam unpackBeam(vec4 place, vec4 turn) {
    return beamFromPoint(mat2(place.xy, place.zw), mat2(turn.xy, turn.zw));
}
vec4 beamPlaceTexel(Beam beam) { return vec4(beam.place[0], beam.place[1]); }
vec4 beamTurnTexel(Beam beam) { return vec4(beam.turn[0], beam.turn[1]); }

#ifdef LIGHT_SPREAD
// What the disc does, in the place of what the cell does.
Beam spreadOf(Beam beam) { return beamFromPoint(beam.spreadPlace, beam.spreadTurn); }

Beam withSpreadOf(Beam beam, Beam other) {
    return Beam(beam.place, beam.turn, other.spreadPlace, other.spreadTurn);
}
#endif

// As three numbers; none where a normal or a position was no number.
vec3 shapeOfForm(mat2 form) {
    vec3 shape = vec3(form[0][0], form[1][1], 0.5 * (form[0][1] + form[1][0]));
    return any(isnan(shape)) || any(isinf(shape)) ? vec3(0.0) : shape;
}

// How a surface's unit normal turns, 1/m: the second fundamental form in basisAcross(normal), for
// whichever side the normal points to. x, y: along the two vectors; z: between them.
vec3 shapeOf(vec3 normal, mat3 turning) {
    mat2x3 tangents = basisAcross(normal);
    return shapeOfForm(transpose(tangents) * (turning * tangents));
}

// The same from how position (m) and unit normal change along two directions on the surface.
vec3 shapeFrom(vec3 normal, mat2x3 positions, mat2x3 normals) {
    mat2x3 tangents = basisAcross(normal);
    mat2 moved = transpose(tangents) * positions;
    mat2 turned = transpose(tangents) * normals;
    float area = determinant(moved);
    if (!(abs(area) > 1e-30)) return vec3(0.0);
    return shapeOfForm(turned * inverse(moved));
}

// A beam that grazes a surface is taken as if it came at this sine at least.
const float kMinBeamSlant = 1e-3;
float boundedSlant(float slant, float minimum) {
    return (slant < 0.0 ? -1.0 : 1.0) * max(abs(slant), minimum);
}

// Where the next cells' rays hit the plane with this unit normal that the photon's ray hits after
// `distance` m: from the photon's hit, m a cell. `farther`: by how much more than that they fly.
mat2x3 beamOnPlane(Beam beam, vec3 direction, float distance, vec3 normal, float minSlant,
                   out vec2 farther) {
    mat2x3 offsets = basisAcross(direction) * (beam.place + distance * beam.turn);
    farther = -(normal * offsets) / boundedSlant(dot(direction, normal), minSlant);
    return offsets + outerProduct(direction, farther);
}
mat2x3 beamOnPlane(Beam beam, vec3 direction, float distance, vec3 normal, float minSlant) {
    vec2 farther;
    return beamOnPlane(beam, direction, distance, normal, minSlant, farther);
}

// One pair of a beam's vectors through one surface (propagatedBeam).
Beam propagatedPair(Beam beam, vec3 before, float distance, vec3 normal, vec3 shape, vec3 after,
                    float eta) {
    mat2x3 places = beamOnPlane(beam, before, distance, normal, kMinBeamSlant);
    mat2x3 turns = basisAcross(before) * beam.turn;
    mat2x3 tangents = basisAcross(normal);
    mat2x3 normals = tangents * (mat2(shape.x, shape.z, shape.z, shape.y) *
                                 (transpose(tangents) * places));
    float slant = dot(before, normal);
    vec2 slants = normal * turns + before * normals;  // of before · normal
    mat2x3 turned;
    if (eta == 0.0) {
        turned = turns - 2.0 * (outerProduct(normal, slants) + slant * normals);
    } else {
        float beyond = boundedSlant(dot(after, normal), kMinBeamSlant);
        float kept = eta * slant - beyond;
        vec2 kepts = (eta - eta * eta * slant / beyond) * slants;
        turned = eta * turns - kept * normals - outerProduct(normal, kepts);
    }
    mat2x3 across = basisAcross(after);
    return beamFromPoint(transpose(across) * places, transpose(across) * turned);
}

// The beam of a photon that leaves the surface that it has hit. `before`, `after`: its directions,
// unit; `normal`: unit, either side; `shape`: its turning; `eta`: index before over index beyond, or
// 0 where it is reflected. Bounded where light leaves at the critical angle.
Beam propagatedBeam(Beam beam, vec3 before, float distance, vec3 normal, vec3 shape, vec3 after,
                    float eta) {
    Beam onward = propagatedPair(beam, before, distance, normal, shape, after, eta);
#ifdef LIGHT_SPREAD
    Beam spread = propagatedPair(spreadOf(beam), before, distance, normal, shape, after, eta);
    onward.spreadPlace = spread.place;
    onward.spreadTurn = spread.turn;
#endif
    return onward;
}
