// SPDX-License-Identifier: MIT
// The longest line of each batch, in fragments: what is right of it in the row texture is empty and
// is neither reduced nor read.
layout(std430) buffer RowExtents {
    uint rowExtents[];
};
uniform int batch;
