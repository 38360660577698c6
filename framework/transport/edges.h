// SPDX-License-Identifier: MIT
// Pixels in which a surface ends: how many places in each are looked at, and how these are kept
// (techniques/reconstruct/edge_samples.h). C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
namespace kaustik::transport {
#endif

const int kEdgeSamples = 4;        // one in each quarter of a pixel
const int kEdgePixelsOfRow = 256;  // in a row of the samples' texture

#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
