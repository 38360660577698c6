// SPDX-License-Identifier: MIT
// A map as it was stored, in floats, so that whoever looks it up reads a texel once.
#include "maps/filtered.glsl"

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    for (int view = 0; view < views; ++view) {
        for (int kind = 0; kind < setsAfter; ++kind)
            storeFiltered(texel, view, kind, sumAt(texel, firstSet(view, kind)));
    }
}
