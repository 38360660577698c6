// SPDX-License-Identifier: MIT
// Follows one photon's ray over the screen, a pixel a step, to its first hit (K06, section 2.1:
// what the lines are compared with).
#include "tracing/tile_search.glsl"

FirstHit marchView(Photon photon, int minimumSteps, int maximumSteps) {
    if (!isNumber(photon)) return noHit();
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return noHit();
    TracedRay ray = tracedRay(photon.positionVs, photon.directionVs, photon.media);
    int steps = stepCount(segment, minimumSteps, maximumSteps);
    StepRange asked = stepsToAsk(segment, steps);
    uint count;
    FirstHit first = firstHitOfSteps(segment, ray, asked.first, asked.end, steps, count);
    countSteps(count);
    return first;
}

// The same in all views.
FirstHit march(Photon photon, int minimumSteps, int maximumSteps) {
#ifdef MANY_VIEWS
    FirstHit first = noHit();
    for (int face = 0; face < viewCount; ++face) {
        viewIndex = face;
        first = nearerHit(first, marchView(photonInView(photon), minimumSteps, maximumSteps));
    }
    return first;
#else
    return marchView(photonInView(photon), minimumSteps, maximumSteps);
#endif
}
