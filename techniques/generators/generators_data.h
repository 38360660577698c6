// SPDX-License-Identifier: MIT
// The caustic generators of a scene (U08, section 4.1) as shaders know them: by them photons find
// the surfaces that lie around what they have left last, and the map that stores them
// (include/surfaces/generators.glsl). C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace kaustik::generators {
using glm::mat4;
using glm::uvec4;
using glm::vec4;
using uint = unsigned int;
#endif

const uint kMaxGenerators = 32u;

// A uniform block (std140).
struct GeneratorsData {
    mat4 eyeToWorld;  // rotation only
    uvec4 count;      // x
    // Boxes along the world's axes, from the eye, m.
    vec4 centers[kMaxGenerators];
    vec4 halfExtents[kMaxGenerators];
    vec4 references[kMaxGenerators];  // the reference points, the same way
};

#ifdef __cplusplus
}  // namespace kaustik::generators
#endif
