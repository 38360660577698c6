// SPDX-License-Identifier: MIT
// The folder of one run: what `kaustik run` writes, and run.json (kaustik.run/1), which says what
// was asked for and lists every file with its size and checksum. A folder without a run.json that
// fits is not a finished run.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "framework/experiment/plan.h"

namespace kaustik::experiment {

// "<hash>", and "<hash>-rN" for the repeats after the first (repeats count from 1): a study that
// is later given more repeats keeps what it has.
[[nodiscard]] std::string folderName(const PlannedRun& run, int repeat);

struct FinishedRun {
    nlohmann::json record;  // run.json
    nlohmann::json report;
    nlohmann::json samples;
};

// Reads a finished run and checks it against its plan and its own checksums. Throws IoError that
// says what is wrong with it.
[[nodiscard]] FinishedRun readFinishedRun(const std::filesystem::path& folder,
                                          const PlannedRun& run, int repeat);

// Writes run.json for a folder that `kaustik run` has just filled. Throws IoError where the report
// is not of the run that was asked for.
void finalizeRun(const std::filesystem::path& folder, const PlannedRun& run, int repeat,
                 double wallSeconds);

// Puts `fresh` in the place of `folder` in one step; what was there is removed. At no moment is
// there neither.
void moveIntoPlace(const std::filesystem::path& fresh, const std::filesystem::path& folder);

}  // namespace kaustik::experiment
