// SPDX-License-Identifier: MIT
#include "framework/gui/recording_name.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdlib>
#include <ctime>

namespace kaustik::gui {

std::string recordingName(const std::string& scene) {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    std::string name = std::filesystem::path(scene).stem().string();
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
    }
    return fmt::format("{}-{:04}{:02}{:02}-{:02}{:02}{:02}", name, local.tm_year + 1900,
                       local.tm_mon + 1, local.tm_mday, local.tm_hour, local.tm_min, local.tm_sec);
}

std::filesystem::path recordFolder(const PanelState& panels) {
    const std::string& typed = panels.recordFolder;
    if (typed.empty()) return ".";
    const char* home = std::getenv("HOME");
    const bool isInHome = typed == "~" || typed.starts_with("~/");
    return isInHome && home != nullptr ? home + typed.substr(1) : typed;
}

}  // namespace kaustik::gui
