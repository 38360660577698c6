// SPDX-License-Identifier: MIT
// kaustik experiment: run does the runs of a study, report draws what they found.
#include <fmt/format.h>

#include <cstdlib>

#include "framework/app/commands.h"
#include "framework/app/numerics.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/experiment/process.h"
#include "framework/experiment/runner.h"
#include "framework/run/progress.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using namespace experiment;

// This very program, even when it is built anew while the experiment runs.
constexpr const char* kThisProgram = "/proc/self/exe";
// Debian's, for which Debian's matplotlib is made; another may come first on the path.
constexpr const char* kPython = "/usr/bin/python3";

RunDefaults runDefaults() {
    const RunOptions options;
    return {options.scene.scene, options.scene.technique, options.scene.size,
            options.frames,      options.warmup,          options.seed,
            options.reference,   options.referencePhotons};
}

[[noreturn]] void failInterrupted(const ExperimentOptions& options, int finished, int planned) {
    throw Error(fmt::format("Interrupted; {} of {} runs are finished. 'kaustik experiment run {} "
                            "{}--resume' does the others.",
                            finished, planned, options.target,
                            options.out.empty() ? "" : "--out " + options.out + " "),
                kExitFailed);
}

void runStudy(const ExperimentOptions& options, const Registry& registry,
              AddHardCases addHardCases) {
    const Spec spec = readSpec(options.target);
    if (!spec.suite.empty()) {
        runSuite(options, spec, registry, addHardCases);
        return;
    }
    const Plan plan = makePlan(spec, runDefaults(), [&](const std::string& technique) {
        return registry.makeParams(registry.findTechnique(technique));
    });
    const fs::path out = options.out.empty() ? fs::path("results/runs/experiments") / plan.spec.name
                                             : fs::path(options.out);
    run::catchInterrupts();
    requireDisabledPasses(plan, kThisProgram, run::isInterrupted);
    std::unique_ptr<run::Progress> progress;
    const RunnerHooks hooks{run::isInterrupted, [&](int done, int total) {
                                if (!progress) {
                                    progress = std::make_unique<run::Progress>("run", total);
                                }
                                progress->update(done);
                            }};
    const RunnerSummary summary = runPlan(plan, {out, options.resume, kThisProgram}, hooks);
    progress.reset();
    if (summary.interrupted) {
        failInterrupted(options, summary.skipped + summary.done - summary.failed, summary.planned);
    }
    if (summary.failed > 0) {
        throw Error(fmt::format("{} of {} runs failed, the first with: {} The 'message' column of "
                                "{} has them all.",
                                summary.failed, summary.planned, summary.firstFailure,
                                (out / "runs.csv").string()),
                    kExitFailed);
    }
    fmt::print("{}: {} runs done, {} there already", plan.spec.name, summary.done, summary.skipped);
    if (summary.damaged > 0) fmt::print(", {} of those done were damaged before", summary.damaged);
    fmt::print("\n");
    fmt::print("wrote {}\nwrote {}\n", (out / "runs.csv").string(),
               (out / "samples.json").string());
    fmt::print("'kaustik experiment report {}' draws them\n", out.string());
}

void drawReport(const ExperimentOptions& options) {
    if (!options.out.empty() || options.resume) {
        throw ConfigError(
            "experiment report takes a folder and no options; --out and --resume are of "
            "'experiment run'.");
    }
    const fs::path folder = options.target;
    if (fs::is_regular_file(folder / "numerics.md")) {
        throw ConfigError(
            fmt::format("{} holds the table of hard cases, which needs no figures: {}.",
                        folder.string(), (folder / "numerics.md").string()));
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
    // -B: leaves no compiled files in the source tree.
    const ProcessOutcome outcome =
        runProcess(python, {"python3", "-B", script.string(), folder.string()},
                   StandardOutput::shared, run::isInterrupted);
    if (outcome.interrupted) throw Error("Interrupted; no report was written.", kExitFailed);
    if (outcome.exitCode != 0) throw IoError(outcome.problem());
}

}  // namespace

void experimentCommand(const ExperimentOptions& options, const Registry& registry,
                       AddHardCases addHardCases) {
    const std::vector<std::string> actions = {"run", "report"};
    if (options.action == "run") {
        runStudy(options, registry, addHardCases);
    } else if (options.action == "report") {
        drawReport(options);
    } else {
        const std::string suggestion = didYouMean(options.action, actions);
        throw ConfigError(
            fmt::format("experiment: there is nothing called '{}'{} There is run and "
                        "report.",
                        options.action, suggestion.empty() ? "." : suggestion));
    }
}

}  // namespace kaustik::app
