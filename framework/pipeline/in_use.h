// SPDX-License-Identifier: MIT
// Which settings matter to a frame: for lists that show no more than those.
#pragma once

#include <string>

#include "framework/pipeline/registry.h"

namespace kaustik {

// Whether a node that the settings choose has the parameter, or all nodes of a stage share it; not
// that of a stage which the chosen driver leaves out, or of lights' maps where light is stored on
// the screen. `name`: in full; the choice of a node itself is none.
[[nodiscard]] bool isInUse(const Registry& registry, const params::ParamSet& params,
                           const std::string& name);

}  // namespace kaustik
