// SPDX-License-Identifier: MIT
#include "framework/app/commands.h"
#ifdef KAUSTIK_HAS_GUI
#include "framework/gui/gui_command.h"
#endif
#include "techniques/register_all.h"

int main(int argc, char** argv) {
    kaustik::app::GuiCommand gui = nullptr;
#ifdef KAUSTIK_HAS_GUI
    gui = &kaustik::gui::guiCommand;
#endif
    return kaustik::app::runCommandLine(argc, argv, kaustik::registerAll(), gui);
}
