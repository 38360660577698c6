// SPDX-License-Identifier: MIT
// An object of a body as shaders know it that go from one body to another: the box that holds it,
// and parts of other bodies where boxes overlap. C++ and GLSL both read this file.
#pragma once

#include "framework/transport/types.h"

#ifdef __cplusplus
namespace kaustik::deferred {
using glm::vec4;
#endif

// A box in a view's space, along the world's axes, m (std430). The centre's w is the body's number,
// and from bodyCount on it has no buffers.
struct BodyBox {
    vec4 centerVs;
    vec4 halfExtent;
};

#ifdef __cplusplus
}  // namespace kaustik::deferred
#endif
