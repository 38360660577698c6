// SPDX-License-Identifier: MIT
// After a batch's photons have been followed: there is room again. One thread.
#include "light_cells/cell_lists.glsl"

layout(local_size_x = 1) in;

void main() {
    counting.photons = 0u;
    if (counting.batches == 0u || counting.moreBatches > 0u) counting.batches += 1u;
    counting.moreBatches = counting.waiting;
    counting.moreCells = counting.waiting;
}
