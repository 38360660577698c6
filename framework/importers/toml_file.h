// SPDX-License-Identifier: MIT
// TOML files by toml++, in this process: what scene::readToml has a reader process do.
#pragma once

#include <filesystem>

#include "framework/scene/files/toml_node.h"

namespace kaustik::scene {

// Deeper than any scene or study goes, and shallow enough for what recurses over tables.
inline constexpr int kMaxTomlDepth = 32;

// Throws ConfigError "file:line: …" for what is not valid TOML or has tables and lists more than
// kMaxTomlDepth deep, and IoError for a file that cannot be read.
[[nodiscard]] TomlNode parseTomlFile(const std::filesystem::path& file);

}  // namespace kaustik::scene
