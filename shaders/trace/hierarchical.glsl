// SPDX-License-Identifier: MIT
// Follows one photon's ray over the screen to its first hit and skips what it cannot hit:
// over squares of 64, 16 and 4 pixels planes through the layers, with how far these stray from
// them, say so. What is left is asked step by step, by the test of all tracers, so that the hits
// are those of a march over every step.
#include "tracing/tile_search.glsl"
#include "layered_depth/pyramid_layout.glsl"

uniform sampler2DArray layerPyramid;

// A ray over the screen, a step at a time.
struct ScreenRay {
    vec2 start;  // px
    vec2 perStep;
    vec2 stepsPerPixel;  // 1 / perStep; 0 where it does not move
    float nearness;      // at the start
    float nearnessPerStep;
    float slack;  // in nearness, for rounding or the paper's epsilon
};

ScreenRay screenRayOf(RaySegment segment, int n) {
    ScreenRay screenRay;
    float count = float(n);
    screenRay.start = segment.nearPixel;
    screenRay.perStep = (segment.farPixel - segment.nearPixel) / count;
    screenRay.stepsPerPixel = vec2(screenRay.perStep.x != 0.0 ? 1.0 / screenRay.perStep.x : 0.0,
                             screenRay.perStep.y != 0.0 ? 1.0 / screenRay.perStep.y : 0.0);
    screenRay.nearness = segment.nearNearness;
    screenRay.nearnessPerStep = (segment.farNearness - segment.nearNearness) / count;
    float largest = max(segment.nearNearness, segment.farNearness);
    screenRay.slack = nearnessRounding(largest);
#ifdef EPSILON_TEST
    screenRay.slack += nearnessMargin(depthOfNearness(largest), trace_epsilon);
#endif
    return screenRay;
}

// The first step after `i` of which the middle lies outside of a square of the level.
int stepBeyond(ScreenRay screenRay, ivec2 square, int level, int i, int n) {
    float side = float(1 << (2 * level));
    vec2 edge = side * (vec2(square) + vec2(greaterThan(screenRay.perStep, vec2(0.0))));
    // A little less, so that rounding leaves no step to the wrong square.
    vec2 steps = (edge - screenRay.start) * screenRay.stepsPerPixel - 0.502;
    float beyond = float(n);
    if (screenRay.perStep.x != 0.0) beyond = min(beyond, steps.x);
    if (screenRay.perStep.y != 0.0) beyond = min(beyond, steps.y);
    return clamp(int(ceil(beyond)), i + 1, n);
}

uvec2 bitOf(int layer) {
    return layer < 32 ? uvec2(1u << layer, 0u) : uvec2(0u, 1u << (layer - 32));
}
// Takes the lowest layer out of a set that is not empty.
int popLowest(inout uvec2 layers) {
    if (layers.x != 0u) {
        int layer = findLSB(layers.x);
        layers.x &= layers.x - 1u;
        return layer;
    }
    int layer = findLSB(layers.y);
    layers.y &= layers.y - 1u;
    return 32 + layer;
}

// Steps [first, end) of a ray, and the layers, a bit each, that it may hit there.
struct StepQuery {
    int first;
    int end;
    uvec2 layers;
};

// Which of the steps [first, end) may hit a layer of the square. Along the ray nearness is linear,
// as on the squares' planes, and so is the ray's distance from one.
StepQuery candidateSteps(ScreenRay screenRay, ivec2 square, int level, int first, int end) {
    vec2 start = screenRay.start - (vec2(square) + 0.5) * float(1 << (2 * level));
    ivec2 texel = pyramidOffset(ivec2(view.sizePixels.xy), level) + square;
    StepQuery query = StepQuery(end, first, uvec2(0u));
#ifdef IN_OUT_TEST
    bool wasBehind = false;  // the layer before, at some step
#endif
    for (int layer = 0; layer < layerCount; ++layer) {
        vec4 plane = texelFetch(layerPyramid, layerTexel(texel, layer), 0);
        if (plane.x <= 0.0) break;  // nor has it a deeper layer
        float away = screenRay.nearness - plane.x - dot(plane.yz, start);
        float awayPerStep = screenRay.nearnessPerStep - dot(plane.yz, screenRay.perStep);
        vec2 across = abs(plane.yz * screenRay.perStep);
        float reach = plane.w + screenRay.slack + 0.5 * (across.x + across.y);
#ifdef IN_OUT_TEST
        vec2 ends = away + awayPerStep * vec2(first, end);
        if (wasBehind && max(ends.x, ends.y) >= -reach)
            query = StepQuery(first, end, query.layers | bitOf(layer) | bitOf(layer - 1));
        wasBehind = min(ends.x, ends.y) <= reach;
#endif
        // Where |away + awayPerStep i| <= reach.
        float scale = 1.0 / (abs(awayPerStep) > 1e-36 ? awayPerStep : 1e-36);
        float middle = -away * scale;
        float extent = abs(reach * scale) + 1e-3;
        vec2 hits = vec2(middle - extent, middle + extent);
        if (hits.y < float(first) || hits.x > float(end)) continue;
        hits = clamp(hits, vec2(first), vec2(end));
        query.first = min(query.first, max(int(ceil(hits.x)) - 1, first));
        query.end = max(query.end, min(int(floor(hits.y)) + 1, end));
        query.layers |= bitOf(layer);
    }
    return query;
}

// Three loops in one: squares until steps are found that may hit something, their layers until the
// ray crosses one, and what that means. Devices that run many photons in step do each for many.
FirstHit traverseView(Photon photon, int minimumSteps, int maximumSteps) {
    FirstHit first = noHit();
    if (!isNumber(photon)) return first;
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return first;
    TracedRay ray = tracedRay(photon.positionVs, photon.directionVs, photon.media);
    int steps = stepCount(segment, minimumSteps, maximumSteps);
    ScreenRay screenRay = screenRayOf(segment, steps);
#ifdef CLOSED_DIELECTRICS
    uint medium = ray.around.x;
    bool mayComeOut = medium != 0u && !isOpen(medium - 1u);
#endif
    StepRange asked = stepsToAsk(segment, steps);
    // A hit may have the step after it asked too, which need not be in the range.
    int last = min(asked.end + 1, steps);
    int level = kPyramidLevels;
    int end = asked.end;
    int firstStep = -1;  // that of `first`
    int i = asked.first;
    StepQuery query = StepQuery(0, 0, uvec2(0u));
    uvec2 layers = uvec2(0u);  // that step i is still to be asked about
    while (i < end) {
        while (i < end && i >= query.end) {
            ivec2 square = texelOfStep(segment, i, steps) >> (2 * level);
            int beyond = stepBeyond(screenRay, square, level, i, last);
            countSquares(1u);
            StepQuery found = candidateSteps(screenRay, square, level, i, beyond);
#ifdef CLOSED_DIELECTRICS
            // What is inside at the square's last step came out nowhere in it, nor in.
            if (mayComeOut) {
                ivec2 last = texelOfStep(segment, beyond - 1, steps);
                float zLast = depthAtIndex(segment, float(beyond) - 1.0, float(steps));
                float zEnd = depthAtIndex(segment, float(beyond), float(steps));
                bool isElsewhere = !isInsideAt(last, medium, min(zLast, zEnd), max(zLast, zEnd));
#ifdef NESTED_BODIES
                isElsewhere = isElsewhere || bodyAround(ray, last, 0.5 * (zLast + zEnd)).layer >= 0;
#endif
                if (isElsewhere || found.layers != uvec2(0u))
                    found = StepQuery(i, beyond, found.layers);
            }
#endif
            if (found.first >= found.end) {
                i = beyond;
                level = min(level + 1, kPyramidLevels);
                continue;
            }
            i = found.first;
            if (level > 1) {
                --level;
                continue;
            }
            query = found;
            layers = query.layers;
            level = 2;
        }
        float t = 0.0;
        int layer = -1;
        LayerSurface surface;
        int step = i;
        while (i < min(query.end, end) && t <= 0.0) {
            step = i;
            if (layers != uvec2(0u)) {
                countSteps(1u);
                layer = popLowest(layers);
                RayStep at = rayStep(segment, i, steps);
                surface = layerAt(at.texel, layer);
                t = hitLayer(ray, at, layer, surface);
            }
#ifdef CLOSED_DIELECTRICS
            else {
                if (mayComeOut && firstStep != i) {
                    LayerHit solid = testExit(segment, ray, i, steps);
                    int there = i - 1;
#ifdef NESTED_BODIES
                    if (solid.layer < 0) {
                        solid = testEntry(segment, ray, i, steps);
                        there = i;
                    }
#endif
                    if (solid.layer >= 0 && (first.hit.layer < 0 || solid.t < first.hit.t)) {
                        if (first.hit.layer < 0) end = min(last, i + 2);
                        first = FirstHit(solid, texelOfStep(segment, there, steps), true, viewIndex,
                                         i);
                        firstStep = i;
                    }
                }
                ++i;
                layers = query.layers;
            }
#else
            if (layers == uvec2(0u)) {
                ++i;
                layers = query.layers;
            }
#endif
        }
        if (t > 0.0) {
            RayStep at = rayStep(segment, step, steps);
            bool isFirst = first.hit.layer < 0;
            if ((isFirst || isNearer(t, first.hit.t, at, step == firstStep)) &&
                isFacingAt(ray, at.texel, surface) &&
                isOnSolid(ray, at.texel, layer, surface, t)) {
                // The next step's surfaces are hit at most half a step before it begins.
                float next = parameterAtIndex(segment, float(step) + 2.0, float(steps));
                bool mayBeNearer = t > at.tEnd - 0.51 * (next - at.tEnd) - 2e-6 * at.zEnd;
                end = min(isFirst ? last : end, mayBeNearer ? step + 2 : step + 1);
                first = FirstHit(LayerHit(t, layer), at.texel, false, viewIndex, step);
                firstStep = step;
            }
        }
    }
    return first;
}

// The same in all views.
FirstHit traverse(Photon photon, int minimumSteps, int maximumSteps) {
#ifdef MANY_VIEWS
    FirstHit first = noHit();
    for (int face = 0; face < viewCount; ++face) {
        viewIndex = face;
        first = nearerHit(first, traverseView(photonInView(photon), minimumSteps, maximumSteps));
    }
    return first;
#else
    return traverseView(photonInView(photon), minimumSteps, maximumSteps);
#endif
}
