// SPDX-License-Identifier: MIT
// Describes report.json to programs that read it.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kaustik::run {

// The JSON Schema of report.json, as this build of the program writes it.
[[nodiscard]] nlohmann::json reportSchema();

}  // namespace kaustik::run
