// SPDX-License-Identifier: MIT
// Follows one photon's ray over the screen, a pixel a step, to its first hit (K06, section 2.1: what
// the lines are compared with).
#include "common/traced_photon.glsl"

FirstHit march(Photon photon, int minimumSteps, int maximumSteps) {
    FirstHit first = FirstHit(LayerHit(0.0, -1), ivec2(0), false);
    if (!isNumber(photon)) return first;
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return first;
    TracedRay ray = TracedRay(photon.positionVs, photon.directionVs, photon.media);
    int steps = stepCount(segment, minimumSteps, maximumSteps);
    // A hit may lie half a step beyond its own, and the next step know a nearer one: it is asked too,
    // as the reduce asks all.
    int end = steps;
    for (int i = 0; i < end; ++i) {
        LayerHit hit = testStep(segment, ray, i, steps);
        bool isExit = false;
#ifdef CLOSED_DIELECTRICS
        isExit = hit.layer < 0 && trace_test == trace_test_crossing;
        if (isExit) hit = testExit(segment, ray, i, steps);
#endif
        if (hit.layer < 0) continue;
        if (first.hit.layer < 0) {
            end = min(end, i + 2);
        } else if (hit.t >= first.hit.t) {
            continue;
        }
        first = FirstHit(hit, texelOfStep(segment, isExit ? i - 1 : i, steps), isExit);
    }
    return first;
}
