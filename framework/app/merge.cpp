// SPDX-License-Identifier: MIT
#include "framework/app/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "framework/core/error.h"
#include "framework/experiment/setting.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using experiment::Setting;

struct SettingsFile {
    fs::path path;
    std::vector<Setting> settings;
};

// What a file says of a key that is no parameter.
struct Found {
    Setting setting;
    const fs::path* file = nullptr;

    template <class Value>
    [[nodiscard]] Value as() const {
        return experiment::runValue(setting).get<Value>();
    }
};

using OptionSetter = void (*)(RunOptions& options, const Found& found);

// How an option takes over what a file says; by key.
const std::map<std::string, OptionSetter>& optionSetters() {
    static const std::map<std::string, OptionSetter> optionSetters = {
        {"scene",
         [](RunOptions& options, const Found& found) {
             options.scene.scene = experiment::sceneArgument(found.setting, *found.file);
             options.scene.scenePlace = found.setting.place;
         }},
        {"technique",
         [](RunOptions& options, const Found& found) {
             options.scene.technique = found.as<std::string>();
         }},
        {"as_published",
         [](RunOptions& options, const Found& found) {
             options.scene.isAsPublished = found.as<bool>();
         }},
        {"size", [](RunOptions& options,
                    const Found& found) { options.scene.size = found.as<std::string>(); }},
        {"time",
         [](RunOptions& options, const Found& found) {
             options.scene.time = fmt::format("{}", found.as<double>());
         }},
        {"disable",
         [](RunOptions& options, const Found& found) {
             options.scene.disabled = found.as<std::vector<std::string>>();
             options.scene.disabledBy = found.setting.place;
         }},
        {"frames",
         [](RunOptions& options, const Found& found) { options.frames = found.as<int>(); }},
        {"warmup",
         [](RunOptions& options, const Found& found) { options.warmup = found.as<int>(); }},
        {"seed",
         [](RunOptions& options, const Found& found) { options.seed = found.as<long long>(); }},
        {"precise",
         [](RunOptions& options, const Found& found) { options.precise = found.as<bool>(); }},
        {"ledger",
         [](RunOptions& options, const Found& found) { options.hasLedger = found.as<bool>(); }},
        {"time_step", [](RunOptions& options,
                         const Found& found) { options.timeStepSeconds = found.as<double>(); }},
        {"reference",
         [](RunOptions& options, const Found& found) {
             options.reference = experiment::referenceArgument(found.setting, *found.file);
         }},
        {"reference_photons",
         [](RunOptions& options, const Found& found) {
             options.referencePhotons = found.as<long long>();
         }},
    };
    return optionSetters;
}

std::string optionOf(std::string key) {
    std::replace(key.begin(), key.end(), '_', '-');
    return key;
}

params::ParamSet makeParams(const SceneOptions& options, const Setting* named,
                            const Registry& registry) {
    try {
        return registry.makeParams(
            registry.findTechnique(options.technique, options.isAsPublished));
    } catch (const ConfigError& error) {
        if (named == nullptr) throw;
        experiment::failAt(*named, error.what());
    }
}

}  // namespace

void mergeSettings(RunOptions& options, const std::set<std::string>& given,
                   const Registry& registry) {
    if (options.scene.merged.empty()) return;
    std::vector<SettingsFile> files;
    for (const std::string& file : options.scene.merged)
        files.push_back({file, experiment::readSettings(file)});

    std::map<std::string, Found> found;
    for (const SettingsFile& file : files) {
        for (const Setting& setting : file.settings) {
            if (!experiment::isRunKey(setting.key)) continue;
            // Also what a later file replaces must make sense.
            static_cast<void>(experiment::runValue(setting));
            found[setting.key] = {setting, &file.path};
        }
    }
    for (const auto& [key, value] : found) {
        if (!given.contains(optionOf(key))) optionSetters().at(key)(options, value);
    }

    const bool isNamedByFile = found.contains("technique") && !given.contains("technique");
    const params::ParamSet params =
        makeParams(options.scene, isNamedByFile ? &found["technique"].setting : nullptr, registry);
    for (const SettingsFile& file : files) {
        for (params::Assignment& assignment : experiment::assignmentsOf(file.settings, params))
            options.scene.parameters.push_back(std::move(assignment));
    }
}

void mergeSettings(ExplainOptions& options, const std::set<std::string>& given,
                   const Registry& registry) {
    RunOptions run;
    run.scene = options.scene;
    mergeSettings(run, given, registry);
    options.scene = run.scene;
}

}  // namespace kaustik::app
