// SPDX-License-Identifier: MIT
// Follows one photon's ray over the screen, a pixel a step, to its first hit (K06, section 2.1:
// what the lines are compared with).
#include "include/traced_photon.glsl"

FirstHit march(Photon photon, int minimumSteps, int maximumSteps) {
    if (!isNumber(photon)) return noHit();
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return noHit();
    TracedRay ray = tracedRay(photon.positionVs, photon.directionVs, photon.media);
    return firstHitOfSteps(segment, ray, stepCount(segment, minimumSteps, maximumSteps));
}
