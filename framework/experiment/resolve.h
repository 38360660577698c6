// SPDX-License-Identifier: MIT
// Makes all the settings of one run from those that an experiment's file writes down.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/experiment/plan.h"

namespace kaustik::experiment {

class Resolver {
  public:
    Resolver(std::filesystem::path specFile, RunDefaults defaults, MakeParams makeParams);

    struct Resolved {
        nlohmann::json settings;
        std::vector<std::string> sceneArguments;
        std::vector<std::string> runArguments;
        std::string disablePlace;
        std::vector<std::string> fullKeys;  // of `chosen`, in its order
        params::ParamSet params;
    };
    // `chosen` counts before `base`. Each of the two may name a key once. Throws ConfigError with
    // the place of the setting, and IoError.
    [[nodiscard]] Resolved resolve(const std::vector<Setting>& base,
                                   const std::vector<Setting>& chosen);

    // The value that a run has for a full key, as a table would show it.
    [[nodiscard]] static nlohmann::json valueOf(const nlohmann::json& settings,
                                                const std::string& fullKey);

  private:
    struct KnownScene {
        nlohmann::json identity;  // {name, fingerprint}
        std::string argument;
        double timeSeconds = 0.0;
    };
    [[nodiscard]] const KnownScene& scene(const Setting& setting);
    // A reference as the settings state it and as the command line takes it.
    [[nodiscard]] std::pair<nlohmann::json, std::string> reference(const Setting& setting) const;

    std::filesystem::path specFile_;
    RunDefaults defaults_;
    MakeParams makeParams_;
    std::map<std::string, KnownScene> scenes_;
};

}  // namespace kaustik::experiment
