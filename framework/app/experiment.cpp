// SPDX-License-Identifier: MIT
// kaustik experiment: run does the runs of a study or a shard of them, merge puts the shards
// together, report draws what they found.
#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "framework/app/commands.h"
#include "framework/app/numerics.h"
#include "framework/app/study_defaults.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/core/shard.h"
#include "framework/experiment/merge.h"
#include "framework/experiment/process.h"
#include "framework/experiment/runner.h"
#include "framework/experiment/selection.h"
#include "framework/run/progress.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using namespace experiment;

// Debian's, for which Debian's matplotlib is made; another may come first on the path.
constexpr const char* kPython = "/usr/bin/python3";

// What is to be done again to go on.
std::string commandLine(const ExperimentOptions& options) {
    std::string only;
    for (const std::string& condition : options.only)
        only += " --only " + condition;
    return fmt::format("kaustik experiment run {}{}{}{} --resume", options.targets.front(),
                       options.out.empty() ? "" : " --out " + options.out,
                       options.shard.empty() ? "" : " --shard " + options.shard, only);
}

const std::string& onlyTarget(const ExperimentOptions& options) {
    if (options.targets.size() == 1) return options.targets.front();
    throw ConfigError(fmt::format("experiment {}: one {} at a time; '{}' is too many.",
                                  options.action, options.action == "run" ? "study" : "folder",
                                  options.targets[1]));
}

[[noreturn]] void failRuns(int failed, int planned, const std::string& first,
                           const std::string& where) {
    throw Error(
        fmt::format("{} of {} runs failed, the first with: {} {}", failed, planned, first, where),
        kExitFailed);
}

std::string inTable(const fs::path& out) {
    return fmt::format("The 'message' column of {} has them all.", (out / "runs.csv").string());
}

RunnerSummary runAll(const Plan& plan, const RunnerOptions& options) {
    std::unique_ptr<run::Progress> progress;
    return runPlan(plan, options, {run::isInterrupted, [&](int done, int total) {
                                       if (!progress) {
                                           progress = std::make_unique<run::Progress>("run", total);
                                       }
                                       progress->update(done);
                                   }});
}

void runStudy(const ExperimentOptions& options, const Registry& registry,
              AddHardCases addHardCases) {
    const Spec spec = readSpec(onlyTarget(options));
    std::optional<Shard> shard;
    if (!options.shard.empty()) shard = parseShard(options.shard, "--shard");
    if (options.incomplete) {
        throw ConfigError("--incomplete is of 'kaustik experiment merge'.");
    }
    if (!spec.suite.empty()) {
        if (shard) {
            throw ConfigError(
                fmt::format("--shard: {} is a suite of hard cases, which one process measures.",
                            options.targets.front()));
        }
        if (!options.only.empty()) {
            throw ConfigError(
                fmt::format("--only: {} is a suite of hard cases, which varies nothing.",
                            options.targets.front()));
        }
        runSuite(options, spec, registry, addHardCases);
        return;
    }
    const auto makeParams = [&](const std::string& technique, bool isAsPublished) {
        return registry.makeParams(registry.findTechnique(technique, isAsPublished));
    };
    const Plan plan = makePlan(spec, studyDefaults(), makeParams);
    const fs::path out = options.out.empty() ? fs::path("results/runs/experiments") / plan.spec.name
                                             : fs::path(options.out);
    std::optional<std::set<std::string>> only;
    if (!options.only.empty()) only = selectRuns(plan, options.only, "--only");
    run::catchInterrupts();
    requireDisabledPasses(plan, kThisProgram, run::isInterrupted);
    const RunnerSummary summary = runAll(plan, {out, options.resume, kThisProgram, shard, only});
    if (summary.interrupted) {
        throw Error(fmt::format("Interrupted; {} of {} runs are finished. '{}' does the others.",
                                summary.skipped + summary.done - summary.failed, summary.planned,
                                commandLine(options)),
                    kExitFailed);
    }
    if (summary.failed > 0) {
        failRuns(summary.failed, summary.planned, summary.firstFailure,
                 shard ? fmt::format("The files *.failed.json in {} have them all.", out.string())
                       : inTable(out));
    }
    fmt::print("{}{}: {} runs done, {} there already", plan.spec.name,
               shard ? fmt::format(", shard {}/{}", shard->number, shard->count) : "", summary.done,
               summary.skipped);
    if (summary.damaged > 0) fmt::print(", {} of those done were damaged before", summary.damaged);
    fmt::print("\n");
    if (shard) {
        fmt::print("'kaustik experiment merge {}' makes the tables of all shards\n", out.string());
        return;
    }
    fmt::print("wrote {}\nwrote {}\n", (out / "runs.csv").string(),
               (out / "samples.json").string());
    fmt::print("'kaustik experiment report {}' draws them\n", out.string());
}

void mergeShards(const ExperimentOptions& options) {
    if (!options.shard.empty() || options.resume || !options.only.empty())
        throw ConfigError(
            "experiment merge: --shard, --only and --resume are of 'experiment run'.");
    if (options.out.empty() && options.targets.size() > 1)
        throw ConfigError("experiment merge: name the folder for the results with --out.");
    const std::vector<fs::path> folders(options.targets.begin(), options.targets.end());
    const fs::path out = options.out.empty() ? folders.front() : fs::path(options.out);
    run::catchInterrupts();
    std::unique_ptr<run::Progress> progress;
    const ResultsMergeSummary summary = mergeResults(
        folders, {out, options.incomplete, run::isInterrupted, [&](int done, int total) {
                      if (!progress) progress = std::make_unique<run::Progress>("run", total);
                      progress->update(done);
                  }});
    progress.reset();
    if (summary.interrupted) {
        throw Error("Interrupted; the tables are not written yet. The same command does the rest.",
                    kExitFailed);
    }
    if (summary.failed > 0)
        failRuns(summary.failed, summary.planned, summary.firstFailure, inTable(out));
    fmt::print("{}: {} of {} runs\n", summary.name, summary.done, summary.planned);
    fmt::print("wrote {}\nwrote {}\n", (out / "runs.csv").string(),
               (out / "samples.json").string());
    fmt::print("'kaustik experiment report {}' draws them\n", out.string());
}

void drawReport(const ExperimentOptions& options) {
    if (!options.out.empty() || options.resume || !options.shard.empty() || !options.only.empty() ||
        options.incomplete) {
        throw ConfigError(
            "experiment report takes a folder and no options; --out, --resume, --shard, --only and "
            "--incomplete are of 'experiment run' and 'experiment merge'.");
    }
    const fs::path folder = onlyTarget(options);
    if (fs::is_regular_file(folder / "numerics.md")) {
        throw ConfigError(
            fmt::format("{} holds the table of hard cases, which needs no figures: {}.",
                        folder.string(), (folder / "numerics.md").string()));
    }
    if (!fs::is_regular_file(folder / "runs.csv") &&
        fs::is_regular_file(folder / "experiment.json")) {
        throw ConfigError(
            fmt::format("{} holds shards that are not merged; 'kaustik experiment merge {}' does.",
                        folder.string(), folder.string()));
    }
    if (!fs::is_regular_file(folder / "runs.csv")) {
        throw ConfigError(
            fmt::format("{} holds no runs.csv; 'kaustik experiment run SPEC.toml "
                        "--out {}' makes one.",
                        folder.string(), folder.string()));
    }
    const char* chosen = std::getenv("KAUSTIK_PYTHON");
    const fs::path python = chosen != nullptr && *chosen != '\0' ? chosen : kPython;
    if (!fs::exists(python)) {
        throw IoError(
            fmt::format("{} is not there, and it draws the figures; install the "
                        "packages python3 and python3-matplotlib.",
                        python.string()));
    }
    run::catchInterrupts();
    std::fflush(stdout);
    const fs::path script = projectRoot() / "experiments/plotting/report.py";
    // -B: leaves no compiled files in the source tree. Its name is its path: by a bare one it would
    // take the modules of whichever Python comes first on the path.
    const ProcessOutcome outcome =
        runProcess(python, {python.string(), "-B", script.string(), folder.string()},
                   StandardOutput::shared, run::isInterrupted);
    if (outcome.interrupted) throw Error("Interrupted; no report was written.", kExitFailed);
    if (outcome.exitCode != 0) throw IoError(outcome.problem());
}

}  // namespace

void experimentCommand(const ExperimentOptions& options, const Registry& registry,
                       AddHardCases addHardCases) {
    const std::vector<std::string> actions = {"run", "merge", "report"};
    if (options.action == "run") {
        runStudy(options, registry, addHardCases);
    } else if (options.action == "merge") {
        mergeShards(options);
    } else if (options.action == "report") {
        drawReport(options);
    } else {
        const std::string suggestion = didYouMean(options.action, actions);
        throw ConfigError(
            fmt::format("experiment: there is nothing called '{}'{} There is run, "
                        "merge and report.",
                        options.action, suggestion.empty() ? "." : suggestion));
    }
}

}  // namespace kaustik::app
