// SPDX-License-Identifier: MIT
// The dielectrics around a photon or a ray of the eye, as materials (index + 1, 0 for vacuum): the
// stack of framework/transport/media_stack.h with the scene's numbers. Of two that overlap, the one
// entered last fills what they share; either may be left before the other, down to the fourth.
#include "include/surface_data.glsl"
#include "framework/transport/media_stack.h"

uint mediaBase() { return uint(materials[0].medium.z); }

uint numberOf(uint medium) { return uint(materials[medium - 1u].medium.x); }

uint innerMedium(uint media) {
    uint number = innermostOf(stackOf(media), mediaBase());
    return number == 0u ? 0u : uint(materials[number - 1u].medium.y);
}

// What is around once the innermost is left.
uint outerMedium(uint media) {
    uint base = mediaBase();
    uint number = innermostOf(stackOf(media) / base, base);
    return number == 0u ? 0u : uint(materials[number - 1u].medium.y);
}

// The innermost four, the innermost first: what a ray asks at every step, found once.
uvec4 innerMedia(uint media) {
    uint base = mediaBase();
    uvec4 around = uvec4(0u);
    uint stack = stackOf(media);
    for (int i = 0; i < 4; ++i) {
        uint number = innermostOf(stack, base);
        around[i] = number == 0u ? 0u : uint(materials[number - 1u].medium.y);
        stack /= base;
    }
    return around;
}

// Whether one more fits.
bool canEnter(uint media, uint medium) {
    return pushOn(stackOf(media), numberOf(medium), mediaBase()) < uint(materials[0].medium.w);
}

// Both forget the side that was left.
uint enterMedium(uint media, uint medium) {
    return pushOn(stackOf(media), numberOf(medium), mediaBase());
}
uint leaveMedium(uint media, uint medium) {
    return takeFrom(stackOf(media), numberOf(medium), mediaBase());
}
