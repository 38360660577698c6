// SPDX-License-Identifier: MIT
// Names the folders that the workbench records into.
#pragma once

#include <string>

namespace kaustik::gui {

// What a recording of a scene is called, by local time: "pool-20261121-143015" for "pool" as for
// "somewhere/pool.toml"; letters, digits, '-' and '_'.
[[nodiscard]] std::string recordingName(const std::string& scene);

}  // namespace kaustik::gui
