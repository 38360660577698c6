// SPDX-License-Identifier: MIT
// Lists of fragments (layers.lists): the pixel's first, in `heads`, and each fragment's next are
// its place + 1, 0 none.
layout(std430) buffer FragmentCounts {
    uint fragmentCounts[];  // by view; what did not fit is counted too
};
uniform int face;
uniform uint capacity;
