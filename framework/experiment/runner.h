// SPDX-License-Identifier: MIT
// Does all runs of a plan, each in a process of its own, and gathers what they found.
//
// In the folder of results:
//   experiment.json       kaustik.experiment/1: name, axes with units, and every run of the plan
//   <hash>[-rN]/          one run (run_folder.h), there only when it is complete
//   <hash>[-rN].failed.json   why a run failed, in its stead
//   runs.csv              one row a run, failed ones included
//   samples.json          kaustik.experiment-samples/1: every frame and pass time of every run
// The last two are of all runs; where they are done in shards, merge.h makes them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "framework/core/shard.h"
#include "framework/experiment/plan.h"

namespace kaustik::experiment {

struct RunnerOptions {
    std::filesystem::path out;
    bool resume = false;            // leaves runs alone that are finished and undamaged
    std::filesystem::path program;  // that does one run
    std::optional<Shard> shard;     // does only this one's runs, and leaves tables to merge.h
    // Does only the runs of these hashes (selection.h); the tables keep what is there of the
    // others.
    std::optional<std::set<std::string>> only = std::nullopt;
};

struct RunnerHooks {
    std::function<bool()> isInterrupted;
    // `done` of the `total` that are to do are finished.
    std::function<void(int done, int total)> onProgress;
};

struct RunnerSummary {
    int planned = 0;  // of this call
    int skipped = 0;  // finished before
    int damaged = 0;  // were there, but had to be done again
    int done = 0;     // now, failed ones included
    int failed = 0;
    bool interrupted = false;
    std::string firstFailure;  // its message
};

// Which passes a run has is known only with a device; so this asks the program itself, once for
// each scene, technique and list of disabled passes. Throws ConfigError "file:line: …".
void requireDisabledPasses(const Plan& plan, const std::filesystem::path& program,
                           const std::function<bool()>& isInterrupted);

// Repeats are interleaved (A B A B), so that a machine that slows down slows all alike. Several
// processes may do shards in one folder. Throws IoError when nothing can be written, and
// ConfigError when another process works in `out`, or shards of another study are there.
[[nodiscard]] RunnerSummary runPlan(const Plan& plan, const RunnerOptions& options,
                                    const RunnerHooks& hooks);

}  // namespace kaustik::experiment
