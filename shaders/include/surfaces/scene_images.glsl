// SPDX-License-Identifier: MIT
// The images of materials and lights: linear RGB, resampled to squares of one size, mip-mapped.
uniform sampler2DArray sceneImages;
