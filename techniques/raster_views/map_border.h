// SPDX-License-Identifier: MIT
// How much of a finer map of a light, one of a part of what its map before covers, is left to that
// one. C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
namespace kaustik {
#endif

// Along each side of such a map, of the side: what has arrived next to the map is missing there, so
// that the eye's receivers are looked up in the map before (maps/projection.frag).
const float kBorderOfPart = 0.0625f;

#ifdef __cplusplus
}  // namespace kaustik
#endif
