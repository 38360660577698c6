// SPDX-License-Identifier: MIT
// The document as an experiment that `kaustik experiment run` does without the workbench, with the
// same bits on the same device.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/gui/document.h"

namespace kaustik::gui {

// Writes NAME.toml into `folder`, and NAME-scene.toml next to it where the scene has been changed
// by hand; gives the files, the experiment first. With a variant B it has two runs. `name`:
// letters, digits, '-' and '_'. Throws ConfigError for another name or settings that make no sense,
// IoError where it cannot be written.
std::vector<std::filesystem::path> writeExperiment(const Document& document,
                                                   const Registry& registry,
                                                   const std::filesystem::path& folder,
                                                   const std::string& name, bool isPrecise);

}  // namespace kaustik::gui
