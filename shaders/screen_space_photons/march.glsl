// SPDX-License-Identifier: MIT
// Follows one photon's ray over the screen, a pixel a step, to its first hit (K06, section 2.1: what
// the lines are compared with).
#include "common/traced_photon.glsl"

FirstHit march(Photon photon, int minimumSteps, int maximumSteps) {
    FirstHit first = noHit();
    if (!isNumber(photon)) return first;
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return first;
    TracedRay ray = TracedRay(photon.positionVs, photon.directionVs, photon.media);
    int steps = stepCount(segment, minimumSteps, maximumSteps);
    int end = steps;
    for (int i = 0; i < end; ++i)
        searchStep(segment, ray, i, steps, first, end);
    return first;
}
