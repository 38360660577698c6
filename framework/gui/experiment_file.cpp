// SPDX-License-Identifier: MIT
#include "framework/gui/experiment_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;

// The scene as a file in `folder` would name it.
std::string seenFrom(const fs::path& folder, const std::string& name) {
    if (!scene::isSceneFile(name)) return name;
    std::error_code error;
    const fs::path from = fs::absolute(folder.empty() ? "." : folder, error);
    const fs::path relative = fs::relative(fs::absolute(name), from, error);
    // Where there is no way from one to the other, the scene is named as it is.
    return error || relative.empty() ? fs::absolute(name, error).string() : relative.string();
}

std::string listOf(const std::set<std::string>& texts) {
    std::string list;
    for (const std::string& text : texts)
        list += (list.empty() ? "" : ", ") + tomlString(text);
    return "[" + list + "]";
}

// What a variant sets: "key = value" lines, or with the value in a list.
std::string settingsText(const Variant& variant, const Registry& registry, bool asAxes) {
    const params::ParamSet params = settingsOf(variant, {1, 1}, registry).params;
    std::string text;
    const auto line = [&](const std::string& key, const std::string& value) {
        text +=
            asAxes ? fmt::format("{} = [{}]\n", key, value) : fmt::format("{} = {}\n", key, value);
    };
    line("technique", tomlString(variant.technique));
    if (variant.isAsPublished) line("as_published", "true");
    for (const params::NamedField& named : params.all()) {
        if (!params.isSetByUser(named.fullName)) continue;
        const std::string type = named.field.typeName();
        const bool isBare = type == "float" || type == "int" || type == "bool";
        line(tomlString(named.fullName),
             isBare ? named.field.text() : tomlString(named.field.text()));
    }
    if (!variant.disabled.empty()) line("disable", listOf(variant.disabled));
    return text;
}

}  // namespace

std::vector<fs::path> writeExperiment(const Document& document, const Registry& registry,
                                      const fs::path& folder, const std::string& name,
                                      bool isPrecise) {
    const bool isName = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
    });
    if (!isName) {
        throw ConfigError(
            fmt::format("'{}' cannot name an experiment: letters, digits, '-' and '_' can.", name));
    }
    std::vector<fs::path> files = {folder / (name + ".toml")};
    std::string scene = seenFrom(folder, document.scene);
    if (document.edits != scene::SceneEdits()) {
        files.push_back(folder / (name + "-scene.toml"));
        writeFileWhole(files.back(), writeSceneFile(name + "-scene", scene, document.edits));
        scene = files.back().filename().string();
    }
    std::string text = fmt::format(
        "# SPDX-License-Identifier: MIT\n# Saved by the workbench.\n"
        "#   kaustik experiment run {}\nname = {}\ndescription = {}\n\n[base]\nscene = {}\n"
        "size = \"{}x{}\"\nframes = 8\nwarmup = 1\nprecise = {}\n",
        files.front().filename().string(), tomlString(name),
        tomlString(fmt::format("As set up in the workbench on {}.", document.scene)),
        tomlString(scene), document.size.width, document.size.height, isPrecise);
    if (document.other) {
        text += "\n[[permute]]\n" + settingsText(document.variant, registry, true);
        text += "\n[[permute]]\n" + settingsText(*document.other, registry, true);
    } else {
        text += settingsText(document.variant, registry, false);
    }
    writeFileWhole(files.front(), text);
    return files;
}

}  // namespace kaustik::gui
