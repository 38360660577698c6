// SPDX-License-Identifier: MIT
// The folder of results of a study: who may write into it, and what it says of all its runs
// together (runner.h names the files).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/experiment/plan.h"
#include "framework/experiment/run_folder.h"
#include "framework/experiment/table.h"

namespace kaustik::experiment {

// The folder of results, held by this process until it ends, however that happens: alone, or
// together with others that do other shards of the same study.
class OutputFolder {
  public:
    enum class Use { alone, shared };
    // Makes the folder. Throws IoError where that fails, and ConfigError where another process
    // holds it in a way that does not go with `use`.
    OutputFolder(const std::filesystem::path& path, Use use);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

  private:
    int lock_ = -1;
};

// experiment.json.
[[nodiscard]] nlohmann::json describe(const Plan& plan);

// What the tables have of one repeat of a run; all empty where there is nothing.
struct Result {
    Row row;
    nlohmann::json samples;
};
[[nodiscard]] Result resultOf(const PlannedRun& run, int repeat, const FinishedRun& finished);
[[nodiscard]] Result failedResult(const PlannedRun& run, int repeat, const std::string& message);

// The folder that keeps what a run has written, and the file that keeps why it failed.
[[nodiscard]] std::filesystem::path runFolder(const std::filesystem::path& out,
                                              const PlannedRun& run, int repeat);
[[nodiscard]] std::filesystem::path failureFile(const std::filesystem::path& out,
                                                const PlannedRun& run, int repeat);

// runs.csv and samples.json, in the order given; empty results are left out. People read the
// repeats of a run next to each other.
void writeRows(const std::filesystem::path& out, const std::vector<const Result*>& results);
void writeSamples(const std::filesystem::path& out, const std::vector<const Result*>& results);

}  // namespace kaustik::experiment
