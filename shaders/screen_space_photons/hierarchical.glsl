// SPDX-License-Identifier: MIT
// Follows one photon's ray over the screen to its first hit and leaves out what it cannot meet: over
// squares of 64, 16 and 4 pixels the ranges of the layers' depths say so. What is left is asked step
// by step, by the test of all tracers, so that the hits are those of a march over every step.
#include "common/traced_photon.glsl"
#include "screen_space_photons/pyramid_layout.glsl"

uniform sampler2DArray layerPyramid;

// The first step after `i` of which the middle lies outside of a square of the level.
int stepBeyond(RaySegment segment, ivec2 square, int level, int i, int n) {
    float side = float(1 << (2 * level));
    vec2 perStep = (segment.farPixel - segment.nearPixel) / float(n);
    float beyond = float(n);
    for (int axis = 0; axis < 2; ++axis) {
        float advance = perStep[axis];
        if (advance == 0.0) continue;
        float edge = side * float(square[axis] + (advance > 0.0 ? 1 : 0));
        beyond = min(beyond, (edge - segment.nearPixel[axis]) / advance - 0.5);
    }
    return clamp(int(ceil(beyond)), i + 1, n);
}

// Whether any layer of the square may be met between two depths.
bool mayMeet(ivec2 square, int level, float zLow, float zHigh) {
    ivec2 texel = pyramidOffset(ivec2(view.sizePixels.xy), level) + square;
    for (int layer = 0; layer < layerCount; ++layer) {
        vec2 range = texelFetch(layerPyramid, ivec3(texel, layer), 0).xy;
        if (range.y <= 0.0) return false;  // nor has it a deeper layer
        if (zLow <= range.y && zHigh >= range.x) return true;
    }
    return false;
}

FirstHit traverse(Photon photon, int minimumSteps, int maximumSteps) {
    FirstHit first = noHit();
    if (!isNumber(photon)) return first;
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return first;
    TracedRay ray = TracedRay(photon.positionVs, photon.directionVs, photon.media);
    int steps = stepCount(segment, minimumSteps, maximumSteps);
    float count = float(steps);
    float slack = trace_test == trace_test_epsilon ? trace_epsilon : 0.0;
#ifdef CLOSED_DIELECTRICS
    uint medium = innerMedium(photon.media);
    bool mayComeOut =
        medium != 0u && !isOpen(medium - 1u) && trace_test == trace_test_crossing;
#endif
    int level = 2;
    int end = steps;
    int i = 0;
    while (i < end) {
        ivec2 square = texelOfStep(segment, i, steps) >> (2 * level);
        int beyond = stepBeyond(segment, square, level, i, steps);
        float zBegin = depthAtIndex(segment, float(i), count);
        float zEnd = depthAtIndex(segment, float(beyond), count);
        float zLow = min(zBegin, zEnd);
        float zHigh = max(zBegin, zEnd);
        bool isAsked = mayMeet(square, level, zLow - slack, zHigh + slack);
#ifdef CLOSED_DIELECTRICS
        // What is inside at the square's last step came out nowhere in it.
        if (!isAsked && mayComeOut) {
            float zLast = depthAtIndex(segment, float(beyond) - 1.0, count);
            isAsked = !isInsideAt(texelOfStep(segment, beyond - 1, steps), medium,
                                  min(zLast, zEnd), max(zLast, zEnd));
        }
#endif
        if (!isAsked && first.hit.layer < 0) {
            i = beyond;
            level = min(level + 1, kPyramidLevels);
            continue;
        }
        if (level > 1) {
            --level;
            continue;
        }
        for (; i < min(beyond, end); ++i)
            searchStep(segment, ray, i, steps, first, end);
        level = 2;
    }
    return first;
}
