// SPDX-License-Identifier: MIT
#include "framework/app/commands.h"
#ifdef KAUSTIK_HAS_GUI
#include "framework/gui/gui_command.h"
#endif
#include "techniques/register_all.h"
#include "techniques/register_hard_cases.h"

#ifdef __SANITIZE_ADDRESS__
// Drivers keep memory, and are unloaded before leaks are looked for, so that its owner is unknown.
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0";
}
#endif

int main(int argc, char** argv) {
    kaustik::app::ProgramParts parts;
    parts.addHardCases = &kaustik::registerHardCases;
#ifdef KAUSTIK_HAS_GUI
    parts.gui = [](const kaustik::app::GuiOptions& options, const kaustik::Registry& registry) {
        kaustik::gui::guiCommand({options.scene, options.describe, options.unattended}, registry);
    };
#endif
    return kaustik::app::runCommandLine(argc, argv, kaustik::registerAll(), parts);
}
