// SPDX-License-Identifier: MIT
// A flat receiver as trace.plane hits it: a parallelogram in eye view space, m. C++ and GLSL both
// read this file.
#pragma once

#include "framework/transport/types.h"

#ifdef __cplusplus
namespace kaustik::planar {
using glm::vec4;
#endif

// A point p of its plane is corner + u edgeU + v edgeV with u = acrossU · (p - corner), v alike.
struct FlatFace {
    vec4 corner;   // xyz: m
    vec4 normal;   // xyz: unit, outward; w: material index + 1
    vec4 acrossU;  // xyz: 1/m; w: its length
    vec4 acrossV;
};

#ifdef __cplusplus
}  // namespace kaustik::planar
#endif
