// SPDX-License-Identifier: MIT
#include "framework/gui/gui_command.h"

#include "framework/gui/priority.h"
#include "framework/gui/workbench.h"
#include "framework/run/progress.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {

void guiCommand(const WorkbenchOptions& options, const Registry& registry) {
    // A scene that does not exist is a wrong request, and no reason to open a window.
    if (!options.scene.empty()) static_cast<void>(scene::loadScene(options.scene));
    run::catchInterrupts();  // Ctrl-C closes the window, which keeps what was set up
    if (options.isUnattended) keepPriority();
    Workbench workbench(registry, options);
    workbench.run();
}

}  // namespace kaustik::gui
