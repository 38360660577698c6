// SPDX-License-Identifier: MIT
// A map as it was stored, in floats, so that whoever looks it up reads a texel once.
#include "maps/filtered.glsl"

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    for (int view = 0; view < views; ++view)
        storeFiltered(texel, view, 0, sumAt(texel, view * setsBefore));
    keepLast(texel);
}
