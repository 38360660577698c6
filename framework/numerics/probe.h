// SPDX-License-Identifier: MIT
// Runs a small compute shader over a list of inputs, to try one GLSL function at a time.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/gl/command.h"
#include "framework/gl/context.h"

namespace kaustik::numerics {

// The shader (in shaders/numerics, say) has storage blocks `Inputs { vec4 inputs[]; }` and
// `Outputs { vec4 outputs[]; }` and a uniform `caseCount`; one thread a case, in groups of 64.
// `bind` adds what else it needs.
[[nodiscard]] std::vector<glm::vec4> probe(
    gl::Context& context, const std::string& shader, const std::vector<glm::vec4>& inputs,
    int caseCount, int outputsPerCase,
    const std::function<void(gl::Command&)>& bind = [](gl::Command&) {});

}  // namespace kaustik::numerics
