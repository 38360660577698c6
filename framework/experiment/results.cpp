// SPDX-License-Identifier: MIT
#include "framework/experiment/results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

}  // namespace

OutputFolder::OutputFolder(const fs::path& path, Use use) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) {
        throw IoError(fmt::format("--out: the folder {} cannot be made: {}.", path.string(),
                                  error.message()));
    }
    lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const int kind = use == Use::alone ? LOCK_EX : LOCK_SH;
    if (lock_ >= 0 && ::flock(lock_, kind | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(lock_);
        throw ConfigError(fmt::format(
            "--out: another experiment is writing into {}; wait for it, or give another folder.",
            path.string()));
    }
    if (use == Use::shared) return;
    // What a process left behind that was killed, on whichever machine.
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with('.') && name.ends_with(".part")) {
            std::error_code ignored;
            fs::remove_all(entry.path(), ignored);
        }
    }
}

OutputFolder::~OutputFolder() {
    if (lock_ >= 0) ::close(lock_);
}

json describe(const Plan& plan) {
    json axes = json::array();
    for (const AxisDescription& axis : plan.axes) {
        axes.push_back({{"key", axis.key},
                        {"unit", axis.unit},
                        {"description", axis.sentence},
                        {"products", axis.products}});
    }
    json runs = json::array();
    for (const PlannedRun& run : plan.runs) {
        runs.push_back({{"hash", run.hash}, {"axes", run.axes}, {"products", run.products}});
    }
    return {{"schema", "kaustik.experiment/1"},
            {"version", versionString()},
            {"name", plan.spec.name},
            {"description", plan.spec.description},
            {"repeats", plan.spec.repeats},
            {"axes", axes},
            {"runs", runs}};
}

Result resultOf(const PlannedRun& run, int repeat, const FinishedRun& finished) {
    Result result;
    result.row = identityColumns(run, repeat, "");
    const Row results = resultColumns(finished.report);
    result.row.insert(result.row.end(), results.begin(), results.end());
    result.samples = {{"hash", run.hash},
                      {"repeat", repeat},
                      {"frame_samples_ms", finished.samples.at("frame_samples_ms")},
                      {"passes", finished.samples.at("passes")}};
    return result;
}

Result failedResult(const PlannedRun& run, int repeat, const std::string& message) {
    return {identityColumns(run, repeat, message), json()};
}

fs::path runFolder(const fs::path& out, const PlannedRun& run, int repeat) {
    return out / folderName(run, repeat);
}

fs::path failureFile(const fs::path& out, const PlannedRun& run, int repeat) {
    return out / (folderName(run, repeat) + ".failed.json");
}

void writeRows(const fs::path& out, const std::vector<const Result*>& results) {
    std::vector<Row> rows;
    for (const Result* result : results) {
        if (!result->row.empty()) rows.push_back(result->row);
    }
    writeFileWhole(out / "runs.csv", toCsv(rows));
}

void writeSamples(const fs::path& out, const std::vector<const Result*>& results) {
    json runs = json::array();
    for (const Result* result : results) {
        if (!result->samples.is_null()) runs.push_back(result->samples);
    }
    const json all = {{"schema", "kaustik.experiment-samples/1"}, {"runs", std::move(runs)}};
    writeFileWhole(out / "samples.json", jsonText(all) + "\n");
}

}  // namespace kaustik::experiment
