// SPDX-License-Identifier: MIT
// Which branches are followed where light parts. What is emitted may become so many photons, and
// where one of them parts its room is shared out between both branches as the light is, so that each
// has room for one at least. A photon without room for two follows the stronger branch. All of this
// changes as evenly from cell to cell as the light does: neighbours take the same paths.
#include "include/surfaces/specular.glsl"

uniform uint branchesOfAll;  // that an emitted photon may become

// Room for itself and others.
uint branchRoomOf(PhotonOrigin origin) {
    return origin.path == kEmittedPath ? branchesOfAll : (origin.branch >> 8u) + 1u;
}

// Its number, of all that the emitted one has become.
uint branchNumberOf(PhotonOrigin origin) { return origin.branch & 0xffu; }

uint branchOf(uint number, uint room) { return number | (room - 1u) << 8u; }

// What the reflected branch has of a room for two or more; `share`: of the light.
uint reflectedRoom(uint room, float share) {
    return clamp(uint(float(room) * share + 0.5), 1u, room - 1u);
}

// Whether both branches go on.
bool partsLight(Photon photon, Hit hit) {
    uint surface = hit.material - 1u;
    if (materialKind(surface) == kMaterialMirror) return false;
    bool enters = dot(photon.directionVs, hit.normalVs) < 0.0;
    uint media = withLeftSide(photon.media, kLeftNone);
    vec2 indices = indicesAt(hit.material, media, enters);
    if (indices.x == indices.y || (enters && !canEnter(media, hit.material))) return false;
    float reflectance =
        interactAt(photon.directionVs, hit.normalVs, indices.x, indices.y).reflectance;
    return reflectance > 0.0 && reflectance < 1.0;
}
