// SPDX-License-Identifier: MIT
#include "framework/experiment/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::TomlNode;
using scene::TomlTable;

const std::vector<std::string>& runKeys() {
    static const std::vector<std::string> keys = {"scene",
                                                  "technique",
                                                  "size",
                                                  "frames",
                                                  "warmup",
                                                  "seed",
                                                  "precise",
                                                  "time",
                                                  "time_step",
                                                  "reference",
                                                  "reference_photons",
                                                  "disable"};
    return keys;
}

std::string requireText(const Setting& setting) {
    if (!setting.value.is_string()) {
        failAt(setting, fmt::format("{} must be text, not {}.", setting.key, setting.value.dump()));
    }
    return setting.value.get<std::string>();
}

long long requireWhole(const Setting& setting, long long minimum, long long maximum) {
    const bool isWhole = setting.value.is_number_integer();
    const long long value = isWhole ? setting.value.get<long long>() : 0;
    if (!isWhole || value < minimum || value > maximum) {
        failAt(setting, fmt::format("{} must be a whole number from {} to {}, not {}.", setting.key,
                                    minimum, maximum, setting.value.dump()));
    }
    return value;
}

double requireSeconds(const Setting& setting) {
    const bool isNumber = setting.value.is_number();
    if (!isNumber || !std::isfinite(setting.value.get<double>())) {
        failAt(setting, fmt::format("{} must be a number of seconds, not {}.", setting.key,
                                    setting.value.dump()));
    }
    return setting.value.get<double>();
}

std::vector<std::string> requireTexts(const Setting& setting) {
    if (setting.value.is_string()) return {setting.value.get<std::string>()};
    if (!setting.value.is_array()) {
        failAt(setting, fmt::format("{} must be a list of texts, not {}.", setting.key,
                                    setting.value.dump()));
    }
    auto texts = setting.value.get<std::vector<std::string>>();
    std::sort(texts.begin(), texts.end());
    texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
    return texts;
}

std::string requireSize(const Setting& setting) {
    params::Extent size;
    const params::Field field{"size", "", "px", &size, 1.0, 16384.0, {}};
    field.set(textOf(setting), "size", setting.place);
    return field.text();
}

// The full name of a parameter; a key that is none is compared with the keys of a run as well.
std::string parameterName(const params::ParamSet& params, const Setting& setting) {
    try {
        return params.resolve(setting.key, setting.place);
    } catch (const ConfigError&) {
        std::vector<std::string> names = runKeys();
        for (const params::NamedField& named : params.all())
            names.push_back(named.fullName);
        const std::string nearest = nearestName(setting.key, names);
        if (!isRunKey(nearest)) throw;
        failAt(setting, fmt::format("'{}' is not a key; did you mean '{}'?", setting.key, nearest));
    }
}

// A file is looked for beside the one that names it, wherever the program is started.
std::string besides(const fs::path& file, const std::string& name) {
    return fs::absolute(file.parent_path() / name).string();
}

}  // namespace

TomlNode SettingReader::parse() const {
    try {
        return scene::readToml(file_);
    } catch (const ConfigError& error) {
        const std::string what = error.what();
        // TOML has no table and value of one name: trace = "lines" beside trace.epsilon.
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

bool isRunKey(const std::string& key) {
    return std::find(runKeys().begin(), runKeys().end(), key) != runKeys().end();
}

json runValue(const Setting& setting) {
    const std::string& key = setting.key;
    if (key == "size") return requireSize(setting);
    if (key == "frames") return requireWhole(setting, 1, 1000000);
    if (key == "warmup") return requireWhole(setting, 0, 1000000);
    if (key == "seed") return requireWhole(setting, INT64_MIN, INT64_MAX);
    if (key == "reference_photons") return requireWhole(setting, 1, kMostReferencePhotons);
    if (key == "time" || key == "time_step") return requireSeconds(setting);
    if (key == "disable") return requireTexts(setting);
    if (key != "precise") return requireText(setting);
    if (!setting.value.is_boolean()) failAt(setting, "precise must be true or false.");
    return setting.value;
}

std::string textOf(const Setting& setting) {
    if (setting.value.is_array()) {
        failAt(setting, fmt::format("{} takes one value, not a list.", setting.key));
    }
    return setting.value.is_string() ? setting.value.get<std::string>() : setting.value.dump();
}

std::string sceneArgument(const Setting& setting, const fs::path& file) {
    const std::string name = requireText(setting);
    return scene::isSceneFile(name) ? besides(file, name) : name;
}

std::string referenceArgument(const Setting& setting, const fs::path& file) {
    const std::string name = requireText(setting);
    if (name == "none" || name == "auto") return name;
    const fs::path found = besides(file, name);
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

void failAt(const Setting& setting, const std::string& message) {
    throw ConfigError(fmt::format("{}: {}", setting.place, message));
}

}  // namespace kaustik::experiment
