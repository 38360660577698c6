// SPDX-License-Identifier: MIT
// JSON as text. Names of files may be any bytes, but JSON is UTF-8: what is not becomes U+FFFD, so
// that a report is written whatever its scene's file is called.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace kaustik {

// On one line, or indented by as many blanks a level.
[[nodiscard]] std::string jsonText(const nlohmann::json& json, int indent = -1);

}  // namespace kaustik
