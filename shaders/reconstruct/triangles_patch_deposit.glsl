// SPDX-License-Identifier: MIT
// What becomes of a patch's flux once it is known what the pixels show of it.
#include "include/maps/deposit.glsl"
#include "framework/transport/primitives.h"

// By what primitive flux has gone to pixels.
void bookDeposit(uint item, vec3 flux) {
    uint part = item % kPatchParts;
    bool isJoined = part == kPatchJoined || part >= kPatchMerged;
    ledgerAdd(isJoined ? kSumTriangles : kSumBeams, flux);
}

void deposit(Patch whole, ivec2 pixel, float share) {
    depositFlux(pixel, whole.flux * share, directionToEye(whole.direction));
}

// What shares are divided by; 0 where no pixel shows any of it. Books what is hidden or next to the
// view.
float account(uint item, Patch whole, bool isWhole, PatchParts parts) {
    float within = parts.on + parts.occluded;
    // All pixels' shares add up to 1 but for their rounding and the bend of perspective within one;
    // what is missing lies next to the view.
    float outside = isWhole ? 0.0 : max(1.0 - within - parts.outside, 0.0);
    float total = within + outside;
    if (total <= 0.0) return 0.0;
    if (parts.on > 0.0) bookDeposit(item, whole.flux * (parts.on / total));
    if (parts.occluded > 0.0) ledgerAdd(kAccountHidden, whole.flux * (parts.occluded / total));
    if (outside > 0.0) ledgerAdd(kAccountOutside, whole.flux * (outside / total));
    return total;
}

// No pixel under the patch shows its surface: the nearest that do get its flux, or else it is edge-on
// or smaller than a pixel, or hidden by its own object.
void depositNear(uint item, Patch whole) {
    vec3 middle = 0.25 * (whole.corners[0] + whole.corners[1] + whole.corners[2] + whole.corners[3]);
#ifdef MANY_VIEWS
    // The face that it lies on sees it at the largest depth.
    mat3 toEye = transpose(mat3(views[0].fromEye));
    int nearest = 0;
    float deepest = -1.0;
    for (int face = 0; face < viewCount; ++face) {
        float depth = -(mat3(views[face].fromEye) * (toEye * middle)).z;
        if (depth > deepest) nearest = face;
        deepest = max(deepest, depth);
    }
    viewIndex = nearest;
    mat3 turn = mat3(view.fromEye) * toEye;
    middle = turn * middle;
    whole.normal = turn * whole.normal;
    whole.direction = turn * whole.direction;
#endif
    if (-middle.z <= view.frustum.z) {
        ledgerAdd(kAccountBehind, whole.flux);
        return;
    }
    vec2 at = pixelOf(middle);
    ivec2 size = ivec2(view.sizePixels.xy);
    if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(size)))) {
        ledgerAdd(kAccountOutside, whole.flux);
        return;
    }
    float nearness[9];
    float sum = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 pixel = ivec2(floor(at)) + ivec2(i % 3, i / 3) - 1;
        nearness[i] = 0.0;
        if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) continue;
        float area;
        int where =
            seenOnPlane(pixel, whole.normal, middle, whole.normal, whole.tolerance, area);
        if (where != kSeenOn) continue;
        nearness[i] = max(1.5 - length(vec2(pixel) + 0.5 - at), 1e-3);
        sum += nearness[i];
    }
    for (int i = 0; i < 9; ++i) {
        ivec2 pixel = ivec2(floor(at)) + ivec2(i % 3, i / 3) - 1;
        if (nearness[i] > 0.0) deposit(whole, pixel, nearness[i] / sum);
    }
    if (sum > 0.0) {
        bookDeposit(item, whole.flux);
        return;
    }
    bool seesFront = dot(whole.normal, viewDirection(middle)) < 0.0;
    ledgerAdd(seesFront ? kAccountEdgeOn : kAccountHidden, whole.flux);
}

// To all pixels of the view that show the patch's surface, of shares that add up to `total`.
void depositParts(Patch whole, PatchOnScreen onto, float total) {
    for (int row = onto.low.y; row <= onto.high.y; ++row) {
        ivec2 columns = columnsOf(onto, row);
        for (int column = columns.x; column <= columns.y; ++column) {
            PatchPixel pixel = patchAt(onto, ivec2(column, row));
            if (pixel.where == kSeenOn && pixel.share > 0.0)
                deposit(whole, ivec2(column, row), pixel.share / total);
        }
    }
}
