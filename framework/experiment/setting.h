// SPDX-License-Identifier: MIT
// One setting as a TOML file states it: a parameter by any unique short form of its name, or one
// of the keys of a run: scene (a name or a file next to the TOML file), technique,
// as_published, size ("WIDTHxHEIGHT"), frames, warmup, seed, precise, ledger, time and time_step
// (seconds),
// reference (none, auto or a file beside), reference_photons (of auto, at least), disable (a list
// of passes).
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/params/assignment.h"
#include "framework/scene/files/toml_node.h"

namespace kaustik::experiment {

// A key with one value (text, whole number, number, true or false, or a list of texts).
struct Setting {
    std::string key;  // as written, dotted
    nlohmann::json value;
    std::string place;  // "file:line"
};

// Reads what the tables of a file hold, and knows where they are. Throws ConfigError "file:line: …"
// for a value that no setting can have.
class SettingReader {
  public:
    explicit SettingReader(std::filesystem::path file) : file_(std::move(file)) {}

    // The whole file. Throws IoError where it cannot be read.
    [[nodiscard]] scene::TomlNode parse() const;
    // A table's settings in the order of the file.
    [[nodiscard]] std::vector<Setting> settings(const scene::TomlNode& table) const;

    using Visitor = std::function<void(const std::string& key, const scene::TomlNode& node)>;
    // The leaves by dotted name, in the order of the file.
    void visit(const scene::TomlNode& table, const std::string& prefix, bool entersInline,
               const Visitor& visitor) const;
    [[nodiscard]] nlohmann::json value(const std::string& key, const scene::TomlNode& node) const;
    [[nodiscard]] std::string place(const scene::TomlNode& node) const;
    [[noreturn]] void fail(const scene::TomlNode& node, const std::string& message) const;

  private:
    std::filesystem::path file_;
};

// The settings of a file that holds nothing else, as `--merge` takes it. Throws ConfigError and
// IoError.
[[nodiscard]] std::vector<Setting> readSettings(const std::filesystem::path& file);

[[nodiscard]] bool isRunKey(const std::string& key);

inline constexpr long long kMaxReferencePhotons = 1'000'000'000'000'000;

// The value of a key of a run, of its type and in its range: size as "WIDTHxHEIGHT", disable as a
// sorted list. Throws ConfigError at the setting's place.
[[nodiscard]] nlohmann::json runValue(const Setting& setting);

// The text of a parameter's value. Throws ConfigError for a list.
[[nodiscard]] std::string textOf(const Setting& setting);

// What `run` takes for the scene, and for the reference, that a setting in `file` names. The second
// throws ConfigError where there is no such file.
[[nodiscard]] std::string sceneArgument(const Setting& setting, const std::filesystem::path& file);
[[nodiscard]] std::string referenceArgument(const Setting& setting,
                                            const std::filesystem::path& file);

// Full keys of the settings in their order: those of a run as they are, those of parameters by full
// name. Throws ConfigError for a name that does not exist, with the nearest, and where two mean the
// same.
[[nodiscard]] std::vector<std::string> fullKeysOf(const std::vector<Setting>& settings,
                                                  const params::ParamSet& params);

// The settings among these that are parameters, under their full names. Throws as fullKeysOf().
[[nodiscard]] std::vector<params::Assignment> assignmentsOf(const std::vector<Setting>& settings,
                                                            const params::ParamSet& params);

// Throws ConfigError with the setting's place.
[[noreturn]] void failAt(const Setting& setting, const std::string& message);

}  // namespace kaustik::experiment
