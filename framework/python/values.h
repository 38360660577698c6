// SPDX-License-Identifier: MIT
// Python's values as the library's and back. Needs the GIL.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/image/image.h"
#include "framework/scene/files/toml_node.h"

namespace kaustik::python {

// Makes None, bool, int, float, str, list and dict of JSON.
[[nodiscard]] pybind11::object toPython(const nlohmann::json& json);

// A setting as it is written on the command line: true, 0.01, lines, 512x512 for (512, 512).
// Throws ConfigError for a value of another kind.
[[nodiscard]] std::string settingText(const std::string& name, pybind11::handle value);
[[nodiscard]] std::map<std::string, std::string> settingTexts(const pybind11::dict& settings);

// A dict as a scene file has it: keys are text; values dicts, lists (tuples, arrays), numbers,
// text, paths, True and False. Throws ConfigError that names the key.
[[nodiscard]] scene::TomlNode tomlFrom(const pybind11::dict& table);

// The image of an array of H x W or H x W x C numbers (buffers, DLPack on the CPU), or of a file,
// whose picture for a display is decoded. `name` is for messages. Throws ConfigError for what is
// no image and IoError for a file that cannot be read.
[[nodiscard]] Image imageFrom(pybind11::handle value, const std::string& name);

}  // namespace kaustik::python
