// SPDX-License-Identifier: MIT
// Counts pixels that span more of a map's texels than are looked up in them (maps/undersampled.h).
layout(std430) buffer UndersampledPixels {
    uint undersampledPixels;
    uint undersampledFactorBits;  // by which factor more at most, the bits of a float
};

// `factor`: above 1.
void countUndersampled(float factor) {
    atomicAdd(undersampledPixels, 1u);
    atomicMax(undersampledFactorBits, floatBitsToUint(min(factor, 1e30)));
}
