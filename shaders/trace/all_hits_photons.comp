// SPDX-License-Identifier: MIT
// Every photon of a list `slots` times, slot by slot; it is on its way in slot 0 alone. One thread a
// photon. (With hits a shader would store into more images than the eight that OpenGL grants it.)
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_beams.glsl"
#include "include/photons/store_photons.glsl"

uniform int slots;

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    for (uint slot = 0u; slot < uint(slots); ++slot) {
        if (slot > 0u) photon.fate = kFateEnded;
        uint next = slot * photons.count + index;
        storeNext(next, photon, originAt(texel));
#ifdef PHOTON_BEAMS
        storeNextBeam(next, beamAt(texel));
#endif
    }
}
