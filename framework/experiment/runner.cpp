// SPDX-License-Identifier: MIT
#include "framework/experiment/runner.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <set>
#include <system_error>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/experiment/process.h"
#include "framework/experiment/run_folder.h"
#include "framework/experiment/table.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using Clock = std::chrono::steady_clock;

constexpr const char* kUnfinished = ".part";
constexpr std::chrono::seconds kTimeBetweenTables{5};

// The folder of results, held by this process alone until it ends, however that happens.
class OutputFolder {
  public:
    explicit OutputFolder(const fs::path& path) {
        std::error_code error;
        fs::create_directories(path, error);
        if (error) {
            throw IoError(fmt::format("--out: the folder {} cannot be made: {}.", path.string(),
                                      error.message()));
        }
        lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            ::close(lock_);
            throw ConfigError(
                fmt::format("--out: another experiment is writing into {}; wait for it, or give "
                            "another folder.",
                            path.string()));
        }
        // What a process left behind that was killed.
        for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with('.') && name.ends_with(kUnfinished)) {
                std::error_code ignored;
                fs::remove_all(entry.path(), ignored);
            }
        }
    }
    ~OutputFolder() {
        if (lock_ >= 0) ::close(lock_);
    }
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

  private:
    int lock_ = -1;
};

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

struct Task {
    const PlannedRun* run;
    int repeat;
    // One of the two, once it is finished:
    Row row;
    json samples;
};

class Runner {
  public:
    Runner(const Plan& plan, const RunnerOptions& options, const RunnerHooks& hooks)
        : options_(options), hooks_(hooks), folder_(options.out) {
        for (int repeat = 1; repeat <= plan.spec.repeats; ++repeat) {
            for (const PlannedRun& run : plan.runs)
                tasks_.push_back({&run, repeat, {}, {}});
        }
        summary_.planned = static_cast<int>(tasks_.size());
        writeFileWhole(options_.out / "experiment.json", jsonText(describe(plan), 2) + "\n");
    }

    RunnerSummary run() {
        std::vector<Task*> left;
        for (Task& task : tasks_) {
            if (options_.resume && isFinished(task)) {
                ++summary_.skipped;
            } else {
                left.push_back(&task);
            }
        }
        for (Task* task : left) {
            if (hooks_.isInterrupted() || !perform(*task)) {
                summary_.interrupted = true;
                break;
            }
            ++summary_.done;
            writeRowsNowAndThen();
            hooks_.onProgress(summary_.done, static_cast<int>(left.size()));
        }
        writeRows();
        writeSamples();
        return summary_;
    }

  private:
    [[nodiscard]] fs::path pathOf(const Task& task) const {
        return options_.out / folderName(*task.run, task.repeat);
    }

    [[nodiscard]] fs::path failureOf(const Task& task) const {
        return options_.out / (folderName(*task.run, task.repeat) + ".failed.json");
    }

    [[nodiscard]] bool isFinished(Task& task) {
        if (!fs::exists(pathOf(task))) return false;
        try {
            gather(task);
            return true;
        } catch (const IoError&) {
            ++summary_.damaged;
            return false;
        }
    }

    void gather(Task& task) const {
        const FinishedRun finished = readFinishedRun(pathOf(task), *task.run, task.repeat);
        task.row = identityColumns(*task.run, task.repeat, "");
        const Row results = resultColumns(finished.report);
        task.row.insert(task.row.end(), results.begin(), results.end());
        task.samples = {{"hash", task.run->hash},
                        {"repeat", task.repeat},
                        {"frame_samples_ms", finished.samples.at("frame_samples_ms")},
                        {"passes", finished.samples.at("passes")}};
    }

    // Gives false when it was interrupted; nothing is left of the run then.
    [[nodiscard]] bool perform(Task& task) {
        const fs::path fresh =
            options_.out / fmt::format(".{}{}", folderName(*task.run, task.repeat), kUnfinished);
        std::vector<std::string> words = {"kaustik", "run"};
        for (const auto* arguments : {&task.run->sceneArguments, &task.run->runArguments})
            words.insert(words.end(), arguments->begin(), arguments->end());
        words.push_back("--out=" + fresh.string());
        const Clock::time_point begin = Clock::now();
        const ProcessOutcome outcome =
            runProcess(options_.program, words, StandardOutput::dropped, hooks_.isInterrupted);
        const double wallSeconds = std::chrono::duration<double>(Clock::now() - begin).count();
        std::string problem = outcome.problem();
        if (!outcome.interrupted && problem.empty()) {
            try {
                sealRun(fresh, *task.run, task.repeat, wallSeconds);
                putInPlace(fresh, pathOf(task));
                gather(task);
            } catch (const IoError& error) {
                problem = error.what();
            }
        }
        std::error_code ignored;
        fs::remove_all(fresh, ignored);
        if (outcome.interrupted) return false;
        if (problem.empty()) {
            fs::remove(failureOf(task), ignored);
        } else {
            recordFailure(task, outcome.exitCode, problem);
        }
        return true;
    }

    void recordFailure(Task& task, int exitCode, const std::string& problem) {
        const json failure = {{"schema", "kaustik.failure/1"},
                              {"hash", task.run->hash},
                              {"repeat", task.repeat},
                              {"exit_code", exitCode},
                              {"message", problem},
                              {"settings", task.run->settings}};
        writeFileWhole(failureOf(task), jsonText(failure, 2) + "\n");
        task.row = identityColumns(*task.run, task.repeat, problem);
        ++summary_.failed;
        if (summary_.firstFailure.empty()) summary_.firstFailure = problem;
    }

    // All tasks that have something to tell, the repeats of a run beside each other, which is how
    // people read them.
    [[nodiscard]] std::vector<const Task*> inReadingOrder() const {
        std::map<std::string, std::vector<const Task*>> repeatsOf;
        for (const Task& task : tasks_)
            repeatsOf[task.run->hash].push_back(&task);
        std::vector<const Task*> ordered;
        for (const Task& first : tasks_) {
            if (first.repeat > 1) break;
            for (const Task* task : repeatsOf[first.run->hash]) {
                if (!task->row.empty()) ordered.push_back(task);
            }
        }
        return ordered;
    }

    void writeRows() {
        std::vector<Row> rows;
        for (const Task* task : inReadingOrder())
            rows.push_back(task->row);
        writeFileWhole(options_.out / "runs.csv", toCsv(rows));
        rowsWritten_ = Clock::now();
    }

    // So that a long study can be looked at while it runs, and after it was killed.
    void writeRowsNowAndThen() {
        if (Clock::now() - rowsWritten_ > kTimeBetweenTables) writeRows();
    }

    void writeSamples() const {
        json runs = json::array();
        for (const Task* task : inReadingOrder()) {
            if (!task->samples.is_null()) runs.push_back(task->samples);
        }
        const json all = {{"schema", "kaustik.experiment-samples/1"}, {"runs", std::move(runs)}};
        writeFileWhole(options_.out / "samples.json", jsonText(all) + "\n");
    }

    const RunnerOptions& options_;
    const RunnerHooks& hooks_;
    OutputFolder folder_;
    std::vector<Task> tasks_;
    RunnerSummary summary_;
    Clock::time_point rowsWritten_{};
};

}  // namespace

void requireDisabledPasses(const Plan& plan, const fs::path& program,
                           const std::function<bool()>& isInterrupted) {
    std::set<std::string> asked;
    for (const PlannedRun& run : plan.runs) {
        const json& settings = run.settings;
        if (settings.at("disable").empty()) continue;
        const json question = {settings.at("scene"), settings.at("technique"),
                               settings.at("disable")};
        if (!asked.insert(question.dump()).second) continue;
        std::vector<std::string> words = {"kaustik", "explain"};
        words.insert(words.end(), run.sceneArguments.begin(), run.sceneArguments.end());
        const ProcessOutcome outcome =
            runProcess(program, words, StandardOutput::dropped, isInterrupted);
        if (outcome.interrupted) return;
        // Whatever else is wrong, such as a missing device, the runs will say.
        if (outcome.exitCode == kExitBadRequest) {
            throw ConfigError(fmt::format("{}: {}", run.disablePlace, outcome.problem()));
        }
    }
}

RunnerSummary runPlan(const Plan& plan, const RunnerOptions& options, const RunnerHooks& hooks) {
    return Runner(plan, options, hooks).run();
}

}  // namespace kaustik::experiment
