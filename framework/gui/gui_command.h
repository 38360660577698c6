// SPDX-License-Identifier: MIT
// kaustik gui.
#pragma once

#include "framework/app/options.h"
#include "framework/pipeline/registry.h"

namespace kaustik::gui {

// Opens the workbench; returns when its window is closed. Throws DeviceError without a display.
void guiCommand(const app::GuiOptions& options, const Registry& registry);

}  // namespace kaustik::gui
