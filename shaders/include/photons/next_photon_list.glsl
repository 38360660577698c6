// SPDX-License-Identifier: MIT
// How long the next list of photons is, and where in its textures each one stands.
#include "include/photons/transfer_map.glsl"
#include "framework/transport/photon_list.h"

layout(std430) readonly buffer NextPhotons {
    PhotonList nextPhotons;
};
