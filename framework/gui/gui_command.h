// SPDX-License-Identifier: MIT
// The command `kaustik gui`.
#pragma once

#include <filesystem>
#include <string>

#include "framework/pipeline/registry.h"

namespace kaustik::gui {

// Opens the workbench; returns when its window is closed. `scene`: "" for as it was left;
// `describe`: the file of the screen map, "" for none. Throws DeviceError without a display.
void guiCommand(const std::string& scene, const std::filesystem::path& describe,
                const Registry& registry);

}  // namespace kaustik::gui
