// SPDX-License-Identifier: MIT
// How the workbench is started.
#pragma once

#include <filesystem>
#include <string>

namespace kaustik::gui {

struct WorkbenchOptions {
    std::string scene;               // "": as it was left, or the default scene
    std::filesystem::path describe;  // file of the screen map; "" for none
    // No hand waits for the window. Of its frames that follow each other at once, as while input is
    // answered, the pixels of few are drawn, since on a processor they take longer than all else;
    // and what is rendered is as urgent as they are.
    bool isUnattended = false;
};

}  // namespace kaustik::gui
