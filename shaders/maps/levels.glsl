// SPDX-License-Identifier: MIT
// Where the coarser levels of a map lie: level 0 is one set of the map, and all others lie side by
// side, each half as wide as the one before, in the next set. `level` 0 of any other set is that.

uniform ivec2 levelZero;  // texels of the map

ivec2 sizeOfLevel(int level) {
    return max((levelZero + ((1 << level) - 1)) >> level, ivec2(1));
}

ivec2 placeOfLevel(int level) {
    int x = 0;
    for (int i = 1; i < level; ++i) x += sizeOfLevel(i).x;
    return ivec2(x, 0);
}

int setOfLevel(int level) { return level > 0 ? 1 : 0; }
