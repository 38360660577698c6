// SPDX-License-Identifier: MIT
// {from, to, factor | step | steps} of an experiment file: a list of values, ends included.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/scene/files/toml_node.h"

namespace kaustik::experiment {

inline constexpr int kMaxValues = 10000;

// Whole numbers where all that is given and all that comes out are whole, else numbers rounded to
// twelve digits, so that 0.1 + 0.2 is 0.3. `key` is for messages. Throws ConfigError "file:line: …"
// for an unknown key, a range without values and one with more than kMaxValues.
[[nodiscard]] std::vector<nlohmann::json> readRange(const scene::TomlNode& table,
                                                    const std::string& key,
                                                    const std::filesystem::path& file);

}  // namespace kaustik::experiment
