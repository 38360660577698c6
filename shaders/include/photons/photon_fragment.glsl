// SPDX-License-Identifier: MIT
// A fragment a photon of a list, drawn by framework/photon_rows.vert. The last row may be shorter.
#include "include/photons/photons.glsl"

bool isPhotonHere() {
    return uint(gl_FragCoord.y) * photons.rowLength + uint(gl_FragCoord.x) < photons.count;
}
