// SPDX-License-Identifier: MIT
// All runs of an experiment, with every setting resolved, before any of them starts. What is wrong
// with the experiment is found here; setting.h has the keys of [base] and [permute].
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/experiment/spec.h"
#include "framework/params/param_set.h"

namespace kaustik::experiment {

// One way to run the program. Runs with equal settings are the same run.
struct PlannedRun {
    // Everything that decides the result, kaustik.settings/1: the program's version, scene with
    // fingerprints of its file and of what that names, technique, all parameters by full name,
    // size, frames, ...; free of paths of this machine.
    nlohmann::json settings;
    std::string hash;                         // fingerprint of the settings' canonical JSON
    std::vector<std::string> sceneArguments;  // SCENE --technique …, as `run` and `explain` take
    std::vector<std::string> runArguments;    // --frames …, as only `run` takes; without --out
    nlohmann::json axes;                      // {full key: value} for every axis of the experiment
    std::vector<int> products;                // of the experiment that this run is part of
    std::string disablePlace;                 // "file:line" of what names the disabled passes
};

// What is varied, for the labels of figures.
struct AxisDescription {
    std::string key;  // full
    std::string unit;
    std::string sentence;
    std::vector<int> products;  // that vary it
};

struct Plan {
    Spec spec;
    std::vector<AxisDescription> axes;
    std::vector<PlannedRun> runs;
};

inline constexpr std::size_t kMaxRuns = 100000;

// What the runs have that the experiment does not say. Taken from the program that will run, so
// that there is one place for a default.
struct RunDefaults {
    std::string scene;
    std::string technique;
    std::string size;
    int frames = 0;
    int warmup = 0;
    long long seed = 0;
    std::string reference;
    long long referencePhotons = 0;
};

// The parameters of a technique with their defaults; throws ConfigError for an unknown one.
using MakeParams =
    std::function<params::ParamSet(const std::string& technique, bool isAsPublished)>;

// Throws ConfigError "file:line: …" for unknown keys, scenes, techniques and parameters (with the
// nearest name), values out of range and runs that occur twice; IoError where a file that a scene
// needs cannot be read.
[[nodiscard]] Plan makePlan(const Spec& spec, const RunDefaults& defaults,
                            const MakeParams& makeParams);

}  // namespace kaustik::experiment
