// SPDX-License-Identifier: MIT
// JSON as text, and from it. Names of files may be any bytes, but JSON is UTF-8: what is not
// becomes U+FFFD, so that a report is written whatever its scene's file is called.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace kaustik {

// The JSON as text on one line, or indented by as many blanks a level.
[[nodiscard]] std::string jsonText(const nlohmann::json& json, int indent = -1);

// Parses files of the project's own, which are read in this process. Throws IoError that names
// `name` for what is no JSON or nested more than 64 deep.
[[nodiscard]] nlohmann::json parseJson(std::string_view text, const std::string& name);

}  // namespace kaustik
