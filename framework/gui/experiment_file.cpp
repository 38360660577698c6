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

// The value of a setting as TOML has it; `params` knows its type.
std::string valueText(const params::ParamSet& params, const std::string& key,
                      const std::string& text) {
    const std::string type = params.find(key).typeName();
    return type == "float" || type == "int" || type == "bool" ? text : tomlString(text);
}

// What a variant sets, but for `varied`: "key = value" lines, or with the value in a list.
std::string settingsText(const Variant& variant, const Registry& registry, bool asAxes,
                         const std::set<std::string>& varied = {}) {
    const params::ParamSet params = settingsOf(variant, {1, 1}, registry).params;
    std::string text;
    const auto line = [&](const std::string& key, const std::string& value) {
        text +=
            asAxes ? fmt::format("{} = [{}]\n", key, value) : fmt::format("{} = {}\n", key, value);
    };
    if (!varied.contains(kTechniqueKey)) line(kTechniqueKey, tomlString(variant.technique));
    if (variant.isAsPublished) line("as_published", "true");
    for (const params::NamedField& named : params.all()) {
        if (!params.isSetByUser(named.fullName) || varied.contains(named.fullName)) continue;
        line(tomlString(named.fullName), valueText(params, named.fullName, named.field.text()));
    }
    if (!variant.disabled.empty()) line("disable", listOf(variant.disabled));
    return text;
}

// One product of all axes. Every technique knows the parameters of all nodes.
std::string axesText(const Study& study, const Registry& registry) {
    const params::ParamSet params = settingsOf(study.document.variant, {1, 1}, registry).params;
    std::string text = "\n[permute]\n";
    for (const StudyAxis& axis : study.axes) {
        std::string values;
        for (const std::string& value : axis.values) {
            values += (values.empty() ? "" : ", ") + (axis.key == kTechniqueKey
                                                          ? tomlString(value)
                                                          : valueText(params, axis.key, value));
        }
        text += fmt::format("{} = [{}]\n",
                            axis.key == kTechniqueKey ? axis.key : tomlString(axis.key), values);
    }
    return text;
}

// NAME.toml up to the settings, which `settings` writes, and the changed scene next to it.
std::vector<fs::path> writeFiles(const Document& document, const fs::path& folder,
                                 const std::string& name, const ExperimentTerms& terms,
                                 const std::string& settings) {
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
        "size = \"{}x{}\"\nframes = {}\nwarmup = {}\nprecise = {}\n",
        files.front().filename().string(), tomlString(name),
        tomlString(fmt::format("As set up in the workbench on {}.", document.scene)),
        tomlString(scene), document.size.width, document.size.height, terms.frames, kStudyWarmup,
        terms.isPrecise);
    if (terms.referencePhotons > 0) {
        text +=
            fmt::format("reference = \"auto\"\nreference_photons = {}\n", terms.referencePhotons);
    }
    writeFileWhole(files.front(), text + settings);
    return files;
}

}  // namespace

std::vector<fs::path> writeExperiment(const Document& document, const Registry& registry,
                                      const fs::path& folder, const std::string& name,
                                      const ExperimentTerms& terms) {
    std::string settings;
    if (document.other) {
        settings += "\n[[permute]]\n" + settingsText(document.variant, registry, true);
        settings += "\n[[permute]]\n" + settingsText(*document.other, registry, true);
    } else {
        settings = settingsText(document.variant, registry, false);
    }
    return writeFiles(document, folder, name, terms, settings);
}

std::vector<fs::path> writeStudy(const Study& study, const Registry& registry,
                                 const fs::path& folder, const std::string& name,
                                 const ExperimentTerms& terms) {
    std::set<std::string> varied;
    for (const StudyAxis& axis : study.axes)
        varied.insert(axis.key);
    return writeFiles(
        study.document, folder, name, terms,
        settingsText(study.document.variant, registry, false, varied) + axesText(study, registry));
}

}  // namespace kaustik::gui
