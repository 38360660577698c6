// SPDX-License-Identifier: MIT
// Runs a compute shader of the tests over a list of inputs, to try one GLSL function at a time.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/gl/command.h"

namespace kaustik::test {

// The shader (a file beside the tests, relative to the project's root) has storage blocks
// `Inputs { vec4 inputs[]; }` and `Outputs { vec4 outputs[]; }` and a uniform `caseCount`; one
// thread a case, in groups of 64. `bind` adds what else it needs.
[[nodiscard]] std::vector<glm::vec4> probe(
    const std::string& shader, const std::vector<glm::vec4>& inputs, int caseCount,
    int outputsPerCase, const std::function<void(gl::Command&)>& bind = [](gl::Command&) {});

}  // namespace kaustik::test
