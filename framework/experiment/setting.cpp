// SPDX-License-Identifier: MIT
#include "framework/experiment/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/experiment/run_keys.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::TomlNode;
using scene::TomlTable;

// The full name of a parameter; a key that is none is compared with the keys of a run as well.
std::string parameterName(const params::ParamSet& params, const Setting& setting) {
    try {
        return params.resolve(setting.key, setting.place);
    } catch (const ConfigError&) {
        std::vector<std::string> names;
        for (const RunKey& key : runKeys())
            names.emplace_back(key.name);
        for (const params::NamedField& named : params.all())
            names.push_back(named.fullName);
        const std::string nearest = nearestName(setting.key, names);
        if (!isRunKey(nearest) || !params.renamedFrom(setting.key).empty()) throw;
        failAt(setting, fmt::format("'{}' is not a key; did you mean '{}'?", setting.key, nearest));
    }
}

// A file is looked for next to the one that names it, wherever the program is started.
std::string siblingPath(const fs::path& file, const std::string& name) {
    return fs::absolute(file.parent_path() / name).string();
}

}  // namespace

TomlNode SettingReader::parse() const {
    try {
        return scene::readToml(file_);
    } catch (const ConfigError& error) {
        const std::string what = error.what();
        // TOML has no table and value of one name: trace = "lines" next to trace.epsilon.
        const bool isBoth = what.find("redefine") != std::string::npos;
        throw ConfigError(
            what + (isBoth ? " Write dotted names in quotes: \"trace.epsilon\" = 0.01." : ""));
    }
}

std::vector<Setting> SettingReader::settings(const TomlNode& table) const {
    std::vector<Setting> settings;
    visit(table, "", true, [&](const std::string& key, const TomlNode& node) {
        settings.push_back({key, value(key, node), place(node)});
    });
    return settings;
}

void SettingReader::visit(const TomlNode& table, const std::string& prefix, bool entersInline,
                          const Visitor& visitor) const {
    std::vector<std::pair<std::string, const TomlNode*>> entries;
    for (const auto& [key, node] : table.entries())
        entries.emplace_back(prefix + key, &node);
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        return std::tie(a.second->line, a.second->column) <
               std::tie(b.second->line, b.second->column);
    });
    for (const auto& [name, node] : entries) {
        const TomlTable* inner = node->as<TomlTable>();
        if (inner != nullptr && (entersInline || !inner->isInline)) {
            visit(*node, name + ".", entersInline, visitor);
        } else {
            visitor(name, *node);
        }
    }
}

json SettingReader::value(const std::string& key, const TomlNode& node) const {
    if (const auto* text = node.as<std::string>()) return *text;
    if (const auto* integer = node.as<std::int64_t>()) return *integer;
    if (const auto* number = node.as<double>()) return *number;
    if (const auto* flag = node.as<bool>()) return *flag;
    const std::vector<TomlNode>* list = node.list();
    if (list == nullptr) {
        fail(node, fmt::format("{} must be text, a number, true or false", key));
    }
    json texts = json::array();
    for (const TomlNode& element : *list) {
        const auto* text = element.as<std::string>();
        if (text == nullptr) {
            fail(element, fmt::format("{} cannot be a list; only disable can, of texts", key));
        }
        texts.push_back(*text);
    }
    return texts;
}

std::string SettingReader::place(const TomlNode& node) const {
    return fmt::format("{}:{}", file_.string(), node.line);
}

void SettingReader::fail(const TomlNode& node, const std::string& message) const {
    throw ConfigError(fmt::format("{}: {}.", place(node), message));
}

std::vector<Setting> readSettings(const fs::path& file) {
    const SettingReader reader(file);
    const TomlNode document = reader.parse();
    for (const char* table : {"base", "permute"}) {
        const TomlNode* node = document.find(table);
        if (node == nullptr) continue;
        reader.fail(*node, fmt::format("[{}] is of an experiment ('kaustik experiment run'); a "
                                       "file of settings has the keys of its [base], without that "
                                       "line",
                                       table));
    }
    return reader.settings(document);
}

std::string textOf(const Setting& setting) {
    if (setting.value.is_array()) {
        failAt(setting, fmt::format("{} takes one value, not a list.", setting.key));
    }
    return setting.value.is_string() ? setting.value.get<std::string>() : setting.value.dump();
}

std::string sceneArgument(const Setting& setting, const fs::path& file) {
    const auto name = runValue(setting).get<std::string>();
    return scene::isSceneFile(name) ? siblingPath(file, name) : name;
}

std::string referenceArgument(const Setting& setting, const fs::path& file) {
    const auto name = runValue(setting).get<std::string>();
    if (name == "none" || name == "auto") return name;
    const fs::path found = siblingPath(file, name);
    if (fs::is_regular_file(found)) return found.string();
    const std::string suggestion = didYouMean(name, {"none", "auto"});
    failAt(setting, fmt::format("reference is none, auto or a file beside this one, and there is "
                                "no file '{}'{}",
                                name, suggestion.empty() ? "." : suggestion));
}

std::vector<std::string> fullKeysOf(const std::vector<Setting>& settings,
                                    const params::ParamSet& params) {
    std::map<std::string, const Setting*> writtenAs;
    std::vector<std::string> keys;
    for (const Setting& setting : settings) {
        keys.push_back(isRunKey(setting.key) ? setting.key : parameterName(params, setting));
        const auto [other, isNew] = writtenAs.emplace(keys.back(), &setting);
        if (!isNew) {
            failAt(setting,
                   fmt::format("'{}' and '{}' ({}) both set {}; leave one of them out.",
                               setting.key, other->second->key, other->second->place, keys.back()));
        }
    }
    return keys;
}

std::vector<params::Assignment> assignmentsOf(const std::vector<Setting>& settings,
                                              const params::ParamSet& params) {
    const std::vector<std::string> fullKeys = fullKeysOf(settings, params);
    std::vector<params::Assignment> assignments;
    for (std::size_t i = 0; i < settings.size(); ++i) {
        if (!isRunKey(settings[i].key))
            assignments.push_back({fullKeys[i], textOf(settings[i]), settings[i].place});
    }
    return assignments;
}

void failAt(const Setting& setting, const std::string& message) {
    throw ConfigError(fmt::format("{}: {}", setting.place, message));
}

}  // namespace kaustik::experiment
