// SPDX-License-Identifier: MIT
// Puts the results of shards together, whatever folders they are in and in whatever order.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace kaustik::experiment {

struct ResultsMergeOptions {
    std::filesystem::path out;  // may be one of the folders; what is there already counts too
    bool incomplete = false;    // runs may be missing
    std::function<bool()> isInterrupted;
    std::function<void(int done, int total)> onProgress;
};

struct ResultsMergeSummary {
    std::string name;  // of the study
    int planned = 0;
    int done = 0;
    int failed = 0;
    int missing = 0;
    bool interrupted = false;
    std::string firstFailure;  // its message
};

// Of a run that several folders hold, the one that was finished first counts, and one that is
// finished counts more than one that failed. Nothing is written unless all folders are of one
// study and, but for `incomplete`, all its runs are there: else a ConfigError says what is wrong.
// Throws IoError where a folder cannot be read or written.
[[nodiscard]] ResultsMergeSummary mergeResults(const std::vector<std::filesystem::path>& folders,
                                               const ResultsMergeOptions& options);

}  // namespace kaustik::experiment
