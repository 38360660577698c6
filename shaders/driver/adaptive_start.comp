// SPDX-License-Identifier: MIT
// The cells that an adaptive traversal begins with: all of every light's. One thread a cell.
#include "include/thread.glsl"
#include "framework/transport/types.h"

layout(std430) writeonly buffer WaitingCells {
    LightCell waitingCells[];
};
uniform uint side;
uniform uint level;
uniform uint cellCount;

void main() {
    uint index = threadNumber();
    if (index >= cellCount) return;
    uint perLight = side * side;
    uint at = index % perLight;
    waitingCells[index] = LightCell(at % side, at / side, level, (index / perLight) << 8u);
}
