// SPDX-License-Identifier: MIT
// The dielectrics around a photon or a ray of the eye, as materials (index + 1, 0 for vacuum): the
// stack of framework/transport/media_stack.h with the scene's numbers. Of two that overlap, the one
// entered last fills what they share; either may be left before the other, down to the fourth.
#include "include/surfaces/surface_data.glsl"
#include "framework/transport/media_stack.h"

// Read before any loop: Mesa's software rasteriser keeps what it has loaded within one for after it,
// and threads that had left the loop before others find 0 there.
uint mediaBase = uint(materials[0].medium.z);
uint mediaEnd = uint(materials[0].medium.w);

uint numberOf(uint medium) { return uint(materials[medium - 1u].medium.x); }

uint innerMedium(uint media) {
    uint number = innermostOf(stackOf(media), mediaBase);
    return number == 0u ? 0u : uint(materials[number - 1u].medium.y);
}

// What is around once the innermost is left.
uint outerMedium(uint media) {
    uint number = innermostOf(stackOf(media) / mediaBase, mediaBase);
    return number == 0u ? 0u : uint(materials[number - 1u].medium.y);
}

// The innermost four, the innermost first: what a ray asks at every step, found once.
uvec4 innerMedia(uint media) {
    uvec4 around = uvec4(0u);
    uint stack = stackOf(media);
    for (int i = 0; i < 4; ++i) {
        uint number = innermostOf(stack, mediaBase);
        around[i] = number == 0u ? 0u : uint(materials[number - 1u].medium.y);
        stack /= mediaBase;
    }
    return around;
}

// Whether any of them has an inside, whose far side a tracer of receivers alone never finds.
bool isInBody(uint media) {
    uvec4 around = innerMedia(media);
    for (int i = 0; i < 4; ++i) {
        if (around[i] != 0u && !isOpen(around[i] - 1u)) return true;
    }
    return false;
}

// Whether one more fits.
bool canEnter(uint media, uint medium) {
    return pushOn(stackOf(media), numberOf(medium), mediaBase) < mediaEnd;
}

// Both forget the side that was left.
uint enterMedium(uint media, uint medium) {
    return pushOn(stackOf(media), numberOf(medium), mediaBase);
}
uint leaveMedium(uint media, uint medium) {
    return takeFrom(stackOf(media), numberOf(medium), mediaBase);
}
