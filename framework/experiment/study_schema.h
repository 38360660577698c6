// SPDX-License-Identifier: MIT
// Describes experiment files to editors.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kaustik::experiment {

// The JSON Schema of experiment files. `params`: all parameters, as `kaustik list params --json`
// prints them; `techniques`: the techniques' names.
[[nodiscard]] nlohmann::json studySchema(const nlohmann::json& params,
                                         const nlohmann::json& techniques);

}  // namespace kaustik::experiment
