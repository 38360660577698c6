// SPDX-License-Identifier: MIT
// The length of a list that holds every photon of another one `slots` times. One thread.
#include "include/photons/photons.glsl"

layout(local_size_x = 1) in;

layout(std430) writeonly buffer NextPhotons {
    PhotonList nextPhotons;
};
uniform int slots;
uniform int nextRowLength;

void main() {
    nextPhotons = photonListOf(photons.count * uint(slots), uint(nextRowLength));
}
