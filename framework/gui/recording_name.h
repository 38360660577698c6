// SPDX-License-Identifier: MIT
// Names the folders that the workbench records into.
#pragma once

#include <filesystem>
#include <string>

#include "framework/gui/state.h"

namespace kaustik::gui {

// What a recording of a scene is called, by local time: "pool-20261121-143015" for "pool" as for
// "somewhere/pool.toml"; letters, digits, '-' and '_'.
[[nodiscard]] std::string recordingName(const std::string& scene);

// The folder that is chosen for recordings (PanelState::recordFolder): "~" and "~/…" are in the
// home folder; "." where nothing is chosen.
[[nodiscard]] std::filesystem::path recordFolder(const PanelState& panels);

}  // namespace kaustik::gui
