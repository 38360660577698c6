// SPDX-License-Identifier: MIT
// How the eye's path through specular surfaces has ended, as View::ending holds it.
#include "framework/transport/types.h"

// `exitDirection`: as ExitDirection.
float pathEndingOf(vec4 exitDirection) {
    bool isNone = exitDirection == vec4(0.0, 0.0, 0.0, kPathLost);
    return isNone ? 0.0 : exitDirection.w + kPathMet;
}
