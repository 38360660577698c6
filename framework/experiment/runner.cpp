// SPDX-License-Identifier: MIT
#include "framework/experiment/runner.h"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <set>
#include <system_error>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/experiment/deal.h"
#include "framework/experiment/process.h"
#include "framework/experiment/results.h"
#include "framework/experiment/run_folder.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kTableInterval{5};

struct Task {
    const PlannedRun* run;
    int repeat;
    Result result;  // once it is finished
};

class Runner {
  public:
    Runner(const Plan& plan, const RunnerOptions& options, const RunnerHooks& hooks)
        : options_(options),
          hooks_(hooks),
          folder_(options.out,
                  options.shard ? OutputFolder::Use::shared : OutputFolder::Use::alone) {
        const std::vector<const PlannedRun*> runs = runsOf(plan, options.shard.value_or(Shard()));
        for (int repeat = 1; repeat <= plan.spec.repeats; ++repeat) {
            for (const PlannedRun* run : runs)
                tasks_.push_back({run, repeat, {}});
        }
        for (const Task& task : tasks_)
            summary_.planned += isWanted(task) ? 1 : 0;
        const fs::path description = options_.out / "experiment.json";
        const std::string text = jsonText(describe(plan), 2) + "\n";
        if (options.shard && fs::exists(description) && readFile(description) != text) {
            throw ConfigError(fmt::format(
                "--out: {} holds results of another study, or of this one before its file, a scene "
                "or the program changed; give another folder.",
                options_.out.string()));
        }
        writeFileWhole(description, text);
    }

    RunnerSummary run() {
        std::vector<Task*> left;
        for (Task& task : tasks_) {
            if (!isWanted(task)) {
                gatherWhatIsThere(task);
            } else if (options_.resume && isFinished(task)) {
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
            writeRowsPeriodically();
            hooks_.onProgress(summary_.done, static_cast<int>(left.size()));
        }
        writeTables();
        return summary_;
    }

  private:
    [[nodiscard]] bool isWanted(const Task& task) const {
        return !options_.only || options_.only->contains(task.run->hash);
    }

    [[nodiscard]] fs::path pathOf(const Task& task) const {
        return runFolder(options_.out, *task.run, task.repeat);
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
        task.result =
            resultOf(*task.run, task.repeat, readFinishedRun(pathOf(task), *task.run, task.repeat));
    }

    // Of a run that is not to be done: its row stays what it was.
    void gatherWhatIsThere(Task& task) const {
        try {
            if (fs::exists(pathOf(task))) {
                gather(task);
            } else if (const fs::path failure = failureFile(options_.out, *task.run, task.repeat);
                       fs::exists(failure)) {
                task.result =
                    failedResult(*task.run, task.repeat,
                                 json::parse(readFile(failure)).at("message").get<std::string>());
            }
        } catch (const IoError&) {  // damaged: as if it were not there
        } catch (const json::exception&) {
        }
    }

    // Gives false when it was interrupted; nothing is left of the run then.
    [[nodiscard]] bool perform(Task& task) {
        const fs::path fresh = unfinishedPath(pathOf(task));
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
                finalizeRun(fresh, *task.run, task.repeat, wallSeconds);
                moveIntoPlace(fresh, pathOf(task));
                gather(task);
            } catch (const IoError& error) {
                problem = error.what();
            }
        }
        std::error_code ignored;
        const fs::path kept =
            failureFile(options_.out, *task.run, task.repeat).replace_extension(".unfinished");
        fs::remove_all(kept, ignored);
        if (!problem.empty()) keepUnfinished(fresh / "unfinished", kept, problem);
        fs::remove_all(fresh, ignored);
        if (outcome.interrupted) return false;
        if (problem.empty()) {
            fs::remove(failureFile(options_.out, *task.run, task.repeat), ignored);
        } else {
            recordFailure(task, outcome.exitCode, problem);
        }
        return true;
    }

    // What a run has left that the device has left, next to the file of its failure, whose message
    // then names that place.
    static void keepUnfinished(const fs::path& unfinished, const fs::path& kept,
                               std::string& problem) {
        std::error_code error;
        if (!fs::exists(unfinished, error)) return;
        fs::create_directories(kept.parent_path(), error);
        fs::rename(unfinished, kept, error);
        if (error) return;
        const std::string from = unfinished.string();
        if (const std::size_t at = problem.find(from); at != std::string::npos)
            problem.replace(at, from.size(), kept.string());
    }

    void recordFailure(Task& task, int exitCode, const std::string& problem) {
        const json failure = {{"schema", "kaustik.failure/1"},
                              {"hash", task.run->hash},
                              {"repeat", task.repeat},
                              {"exit_code", exitCode},
                              {"message", problem},
                              {"settings", task.run->settings}};
        writeFileWhole(failureFile(options_.out, *task.run, task.repeat),
                       jsonText(failure, 2) + "\n");
        task.result = failedResult(*task.run, task.repeat, problem);
        ++summary_.failed;
        if (summary_.firstFailure.empty()) summary_.firstFailure = problem;
    }

    [[nodiscard]] std::vector<const Result*> inReadingOrder() const {
        std::map<std::string, std::vector<const Result*>> repeatsOf;
        for (const Task& task : tasks_)
            repeatsOf[task.run->hash].push_back(&task.result);
        std::vector<const Result*> ordered;
        for (const Task& first : tasks_) {
            if (first.repeat > 1) break;
            const auto& repeats = repeatsOf[first.run->hash];
            ordered.insert(ordered.end(), repeats.begin(), repeats.end());
        }
        return ordered;
    }

    // A shard knows too little of the study for them.
    void writeTables() {
        if (options_.shard) return;
        writeRows(options_.out, inReadingOrder());
        writeSamples(options_.out, inReadingOrder());
    }

    // So that a long study can be looked at while it runs, and after it was killed.
    void writeRowsPeriodically() {
        if (options_.shard || Clock::now() - rowsWritten_ <= kTableInterval) return;
        writeRows(options_.out, inReadingOrder());
        rowsWritten_ = Clock::now();
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
    std::set<std::string> requested;
    for (const PlannedRun& run : plan.runs) {
        const json& settings = run.settings;
        if (settings.at("disable").empty()) continue;
        const json question = {settings.at("scene"), settings.at("technique"),
                               settings.value("as_published", false), settings.at("disable")};
        if (!requested.insert(question.dump()).second) continue;
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
