// SPDX-License-Identifier: MIT
// The dielectrics around a photon or a ray of the eye as one number that a 32-bit float holds
// exactly: a stack of their numbers (scene/dielectrics.h), the innermost in the lowest digit, by
// the scene's base; and above it the side of an open mirror that has just been left (kLeft…).
// C++ and GLSL both read this file.
#pragma once

#include "framework/transport/types.h"

#ifdef __cplusplus
namespace kaustik::transport {
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define KAUSTIK_INLINE
#endif

KAUSTIK_INLINE uint stackOf(uint media) {
    return media % kMediaRoom;
}
KAUSTIK_INLINE uint leftSide(uint media) {
    return media / kMediaRoom;
}
KAUSTIK_INLINE uint withLeftSide(uint media, uint side) {
    return stackOf(media) + kMediaRoom * side;
}
// 0: nothing is around it.
KAUSTIK_INLINE uint innermostOf(uint stack, uint base) {
    return stack % base;
}
KAUSTIK_INLINE uint pushOn(uint stack, uint number, uint base) {
    return number + base * stack;
}
// What one digit of the stack stands for: the innermost that holds `number`; 0 where none does.
KAUSTIK_INLINE uint placeOf(uint stack, uint number, uint base) {
    uint place = 1u;
    for (uint rest = stack; rest > 0u; rest /= base) {
        if (rest % base == number) return place;
        place *= base;
    }
    return 0u;
}
// The stack without the innermost `number`, which need not be the innermost of all.
KAUSTIK_INLINE uint takeFrom(uint stack, uint number, uint base) {
    uint place = placeOf(stack, number, base);
    if (place == 0u) return stack;
    return stack / (place * base) * place + stack % place;
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
