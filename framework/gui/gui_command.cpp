// SPDX-License-Identifier: MIT
#include "framework/gui/gui_command.h"

#include "framework/app/progress.h"
#include "framework/gui/workbench.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {

void guiCommand(const app::GuiOptions& options, const Registry& registry) {
    // A scene that does not exist is a wrong request, and no reason to open a window.
    if (!options.scene.empty()) static_cast<void>(scene::loadScene(options.scene));
    app::catchInterrupts();  // Ctrl-C closes the window, which keeps what was set up
    Workbench workbench(registry, {options.scene, options.describe});
    workbench.run();
}

}  // namespace kaustik::gui
