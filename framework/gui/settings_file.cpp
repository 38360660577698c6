// SPDX-License-Identifier: MIT
#include "framework/gui/settings_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kName = "workbench.json";

// Settings of a version that had other names, or of a technique that is no longer there.
void requireKnownNames(Document& document, const Registry& registry,
                       std::vector<std::string>& problems) {
    try {
        static_cast<void>(settingsOf(document.variant, {1, 1}, registry));
        if (document.other) static_cast<void>(settingsOf(*document.other, {1, 1}, registry));
    } catch (const Error& error) {
        problems.emplace_back(error.what());
        document.variant = {};
        document.other.reset();
    }
}

}  // namespace

Settings readSettings(const fs::path& folder, const Registry& registry) {
    Settings settings;
    const fs::path file = folder / kName;
    std::error_code error;
    if (folder.empty() || !fs::exists(file, error)) return settings;
    std::vector<std::string>& problems = settings.problems;
    try {
        const json all = parseJson(readFile(file), file.string());
        settings.kept = savedStateFromJson(all, problems);
        if (all.is_object() && all.contains("document")) {
            settings.document = documentFromJson(all.at("document"), problems);
            requireKnownNames(settings.document, registry, problems);
        }
    } catch (const std::exception& problem) {  // it cannot be read, or is no JSON
        problems.emplace_back(problem.what());
    }
    return settings;
}

SettingsBackup setSettingsAside(const fs::path& folder, const std::vector<std::string>& problems) {
    const std::string others =
        problems.size() > 1 ? fmt::format(", and {} more", problems.size() - 1) : "";
    const std::string what = fmt::format("Some settings of the last time were dropped ({}{}).",
                                         problems.front(), others);
    std::error_code error;
    fs::path aside;
    int number = 1;
    do {
        aside = folder / fmt::format("workbench-damaged-{}.json", number++);
    } while (fs::exists(aside, error));
    fs::rename(folder / kName, aside, error);
    if (error) {
        return {fmt::format("{} Their file cannot be put aside ({}), so that nothing is kept this "
                            "time: {}",
                            what, error.message(), (folder / kName).string()),
                false};
    }
    return {fmt::format("{} Their file is kept as {}.", what, aside.string()), true};
}

void writeSettings(const fs::path& folder, const std::string& text) {
    writeFileWhole(folder / kName, text);
}

}  // namespace kaustik::gui
