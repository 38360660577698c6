// SPDX-License-Identifier: MIT
// A filter that is wrong: half of the flux, with all that belongs to the whole of it.
#include "maps/filtered.glsl"

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    for (int view = 0; view < views; ++view) {
        for (int kind = 0; kind < setsAfter; ++kind) {
            vec3 sum = sumAt(texel, firstSet(view, kind));
            storeFiltered(texel, view, kind, kind == 0 ? 0.5 * sum : sum);
        }
    }
}
