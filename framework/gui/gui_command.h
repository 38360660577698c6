// SPDX-License-Identifier: MIT
// The command `kaustik gui`.
#pragma once

#include "framework/gui/workbench_options.h"
#include "framework/pipeline/registry.h"

namespace kaustik::gui {

// Opens the workbench; returns when its window is closed. Throws DeviceError without a display.
void guiCommand(const WorkbenchOptions& options, const Registry& registry);

}  // namespace kaustik::gui
