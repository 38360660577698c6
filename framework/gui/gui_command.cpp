// SPDX-License-Identifier: MIT
#include "framework/gui/gui_command.h"

#include "framework/gui/workbench.h"
#include "framework/run/progress.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {

void guiCommand(const std::string& scene, const std::filesystem::path& describe,
                const Registry& registry) {
    // A scene that does not exist is a wrong request, and no reason to open a window.
    if (!scene.empty()) static_cast<void>(scene::loadScene(scene));
    run::catchInterrupts();  // Ctrl-C closes the window, which keeps what was set up
    Workbench workbench(registry, {scene, describe});
    workbench.run();
}

}  // namespace kaustik::gui
