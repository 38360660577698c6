// SPDX-License-Identifier: MIT
// Counts the fragments of each pixel by additive blending (K06, section 2.2).
layout(location = 0) out float count;

void main() {
    count = 1.0;
}
