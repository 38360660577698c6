// SPDX-License-Identifier: MIT
// The file of what survives a restart. One that is damaged is put aside under another name, never
// replaced: what is in it may be worth mending.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/gui/document.h"
#include "framework/gui/state.h"

namespace kaustik::gui {

struct Settings {
    SavedState kept;
    Document document;
    std::vector<std::string>
        problems;  // with the file; what of it makes sense is used all the same
};

// workbench.json in the folder, or what there is at the first start.
[[nodiscard]] Settings readSettings(const std::filesystem::path& folder, const Registry& registry);

struct SettingsBackup {
    std::string notice;   // what was wrong, and what has become of the file
    bool isDone = false;  // if not, nothing may be written
};
// Gives a file with such problems a name that no other has.
[[nodiscard]] SettingsBackup setSettingsAside(const std::filesystem::path& folder,
                                              const std::vector<std::string>& problems);

// Throws IoError.
void writeSettings(const std::filesystem::path& folder, const std::string& text);

}  // namespace kaustik::gui
