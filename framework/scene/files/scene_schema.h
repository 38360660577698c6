// SPDX-License-Identifier: MIT
// Describes scene files to editors.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kaustik::scene {

// The JSON Schema of scene files. What concerns several keys at once, and names of files, only the
// reader knows.
[[nodiscard]] nlohmann::json sceneSchema();

}  // namespace kaustik::scene
