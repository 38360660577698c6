// SPDX-License-Identifier: MIT
// JSON as text, and from it. Names of files may be any bytes, but JSON is UTF-8: what is not
// becomes U+FFFD, so that a report is written whatever its scene's file is called.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace kaustik {

// On one line, or indented by as many blanks a level.
[[nodiscard]] std::string jsonText(const nlohmann::json& json, int indent = -1);

// Deeper than anything here or any exporter nests, and shallow enough for what recurses over it.
inline constexpr int kMaxJsonDepth = 64;

// Throws IoError that names `name` for what is nested deeper than that. The parser could be asked
// to watch the depth, but looks at all that an object's parent holds so far when the object ends:
// 300,000 nodes would take half a minute.
void requireShallowJson(std::string_view text, const std::string& name);

// Throws IoError that names `name` for what is no JSON or too deep.
[[nodiscard]] nlohmann::json parseJson(std::string_view text, const std::string& name);

}  // namespace kaustik
