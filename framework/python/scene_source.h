// SPDX-License-Identifier: MIT
// Finds the scene that Python names: a shipped one, a file, or a dict.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>

#include "framework/scene/files/toml_node.h"
#include "framework/scene/scene.h"

namespace kaustik::python {

class SceneSource {
  public:
    // `base` is the folder that a dict's files are seen from. Throws ConfigError for a value of
    // another kind. Needs the GIL.
    SceneSource(pybind11::handle scene, const std::string& base);

    // Needs no GIL. Throws as loadScene().
    [[nodiscard]] scene::Scene load() const;

  private:
    std::string nameOrPath_;
    std::optional<scene::TomlNode> table_;
    std::filesystem::path base_;
};

}  // namespace kaustik::python
