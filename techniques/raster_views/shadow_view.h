// SPDX-License-Identifier: MIT
// One view of a light's shadow map. C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace kaustik {
using glm::mat4;
#endif

// A layer of the map (std430).
struct ShadowView {
    mat4 eyeToLight;  // from the eye's view space to the light's, rigid
    mat4 projection;
};

#ifdef __cplusplus
}  // namespace kaustik
#endif
