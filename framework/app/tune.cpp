// SPDX-License-Identifier: MIT
// kaustik tune: which technique, with how many photons, has an error first on this device, or the
// least error within a time. Rounds of short studies (experiment/runner.h), each of what the ones
// before make worth trying; the same command goes on where it was ended.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/app/commands.h"
#include "framework/app/study_defaults.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/experiment/results.h"
#include "framework/experiment/runner.h"
#include "framework/experiment/tune.h"
#include "framework/pipeline/default_technique.h"
#include "framework/pipeline/stages.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using namespace experiment;
using nlohmann::json;

// All techniques whose photons are a grid of a light's, and what the default one is with other
// reconstructions.
std::vector<Mixture> mixturesToTry(const Registry& registry) {
    std::vector<Mixture> mixtures;
    for (const Technique& technique : registry.techniques()) {
        const params::ParamSet params = registry.makeParams(technique);
        if (params.choice(DriverStage::name) == "adaptive" ||
            params.choice(EmitStage::name) != "grid")
            continue;
        mixtures.push_back({technique.name, {}});
    }
    for (const char* reconstruct : {"beams", "sprites"})
        mixtures.push_back({kDefaultTechnique, {{ReconstructStage::name, reconstruct}}});
    return mixtures;
}

struct Wanted {
    std::size_t mixture;
    int side;
    friend auto operator<=>(const Wanted&, const Wanted&) = default;
};

class Tuning {
  public:
    Tuning(const TuneOptions& options, const Registry& registry)
        : options_(options),
          registry_(registry),
          goal_{options.error, options.milliseconds},
          mixtures_(mixturesToTry(registry)),
          out_(options.out.empty() ? fs::path("results/runs/tune") / fs::path(options.scene).stem()
                                   : fs::path(options.out)) {}

    void run() {
        std::vector<Wanted> wanted;
        for (std::size_t i = 0; i < mixtures_.size(); ++i)
            wanted.push_back({i, 128});
        measure(wanted);
        if (points_.empty()) {
            throw Error(fmt::format("No technique renders {} with an error: {}", options_.scene,
                                    firstFailure_),
                        kExitFailed);
        }
        // Fewer and fewer mixtures, nearer and nearer to the goal.
        for (const std::size_t kept : {4u, 3u, 2u, 1u, 1u})
            measure(mostPromising(kept));
    }

    [[nodiscard]] const TunePoint* best() const { return bestOf(points_, goal_); }
    [[nodiscard]] const std::vector<TunePoint>& points() const { return points_; }

    void print() const {
        fmt::print("{:<44}{:>10}{:>18}{:>12}{:>12}\n", "on the front", "photons", "ms", "relMSE",
                   "its noise");
        for (const TunePoint& point : frontOf(points_)) {
            fmt::print("{:<44}{:>10}{:>18}{:>12.3g}{:>12.2g}\n", nameOf(mixtures_[point.mixture]),
                       fmt::format("{0}x{0}", point.side),
                       fmt::format("{:.1f} +- {:.1f}", point.milliseconds, point.deviation),
                       point.error, point.noise);
        }
        std::set<std::size_t> failed = failures_;
        for (const TunePoint& point : points_)
            failed.erase(point.mixture);
        if (!failed.empty()) {
            fmt::print("{} of {} ways to render do not go with this scene, the first because: {}\n",
                       failed.size(), mixtures_.size(), firstFailure_);
        }
    }

    [[nodiscard]] std::string settingsOf(const TunePoint& point) const {
        const Mixture& mixture = mixtures_[point.mixture];
        std::string text = fmt::format(
            "# kaustik tune {} {}: relMSE {:.3g}, net of the reference's noise of {:.2g}, in "
            "{:.1f} ms "
            "of the caustic's passes, at {}.\n# kaustik run {} --merge {}\n",
            options_.scene, goalText(), point.error, point.noise, point.milliseconds, options_.size,
            options_.scene, (out_ / "tuned.toml").string());
        text += fmt::format("technique = {}\n", json(mixture.technique).dump());
        for (const auto& [key, value] : mixture.settings)
            text += fmt::format("{} = {}\n", json(key).dump(), json(value).dump());
        return text + fmt::format("\"emit.photons\" = \"{0}x{0}\"\n", point.side);
    }
    [[nodiscard]] std::string goalText() const {
        return goal_.error ? fmt::format("--error {:g}", *goal_.error)
                           : fmt::format("--time {:g}", *goal_.milliseconds);
    }
    [[nodiscard]] const fs::path& out() const { return out_; }

  private:
    // Of the mixtures that are expected to do best, the runs that are not done yet.
    [[nodiscard]] std::vector<Wanted> mostPromising(std::size_t count) const {
        std::vector<Wanted> wanted;
        const TunePoint* const found = best();
        for (const TuneGuess& guess : guesses(points_, goal_)) {
            if (wanted.size() == count) break;
            // Once something meets the goal, what is not expected to be better is no longer tried.
            const bool isWorse = found != nullptr &&
                                 (goal_.error ? guess.milliseconds >= found->milliseconds ||
                                                    guess.error > 1.1 * *goal_.error
                                              : guess.error >= found->error ||
                                                    guess.milliseconds > 1.1 * *goal_.milliseconds);
            const Wanted one{guess.mixture, guess.side};
            if (!isWorse && asked_.count(one) == 0) wanted.push_back(one);
        }
        return wanted;
    }

    [[nodiscard]] std::string studyOf(const std::vector<Wanted>& wanted) const {
        const bool isFile = scene::isSceneFile(options_.scene);
        const std::string scene = isFile ? fs::absolute(options_.scene).string() : options_.scene;
        std::string text = fmt::format(
            "name = \"tune-{}\"\ndescription = \"What kaustik tune tried.\"\n[base]\nscene = {}\n"
            "size = \"{}\"\nframes = 3\nwarmup = 1\nprecise = true\nreference = \"auto\"\n"
            "reference_photons = {}\n",
            round_, json(scene).dump(), options_.size, options_.referencePhotons);
        for (const Wanted& one : wanted) {
            const Mixture& mixture = mixtures_[one.mixture];
            text += fmt::format("[[permute]]\ntechnique = [{}]\n", json(mixture.technique).dump());
            for (const auto& [key, value] : mixture.settings)
                text += fmt::format("{} = [{}]\n", json(key).dump(), json(value).dump());
            text += fmt::format("\"emit.photons\" = [\"{0}x{0}\"]\n", one.side);
        }
        return text;
    }

    void measure(const std::vector<Wanted>& wanted) {
        if (wanted.empty()) return;
        ++round_;
        asked_.insert(wanted.begin(), wanted.end());
        // All in one folder, so that another goal finds them there too.
        const fs::path folder = out_ / "runs";
        fs::create_directories(out_);
        const fs::path file = out_ / fmt::format("round-{}.toml", round_);
        writeFileWhole(file, studyOf(wanted));
        const Plan plan = makePlan(
            readSpec(file), studyDefaults(), [&](const std::string& technique, bool isAsPublished) {
                return registry_.makeParams(registry_.findTechnique(technique, isAsPublished));
            });
        run::Progress progress(fmt::format("round {}, run", round_),
                               static_cast<int>(plan.runs.size()));
        const RunnerSummary summary =
            runPlan(plan, {folder, true, kThisProgram, {}},
                    {run::isInterrupted, [&](int done, int) { progress.update(done); }});
        if (summary.interrupted) {
            throw Error("Interrupted; the same command goes on from what is measured.",
                        kExitFailed);
        }
        if (firstFailure_.empty()) firstFailure_ = summary.firstFailure;
        for (const PlannedRun& run : plan.runs)
            read(folder, run, wanted);
    }

    void read(const fs::path& folder, const PlannedRun& run, const std::vector<Wanted>& wanted) {
        const fs::path place = runFolder(folder, run, 1);
        for (const int product : run.products) {
            const Wanted& one = wanted.at(static_cast<std::size_t>(product));
            if (fs::exists(failureFile(folder, run, 1)) || !fs::is_directory(place)) {
                failures_.insert(one.mixture);
                continue;
            }
            const json report = readFinishedRun(place, run, 1).report;
            if (const std::optional<TunePoint> point = pointOf(report, one)) {
                points_.push_back(*point);
            } else {
                failures_.insert(one.mixture);
                if (firstFailure_.empty()) firstFailure_ = "its report has no error of a caustic.";
            }
        }
    }

    // None where the report has no error of a caustic.
    [[nodiscard]] static std::optional<TunePoint> pointOf(const json& report, const Wanted& one) {
        const json* error =
            report.contains("error") && report["error"].contains("caustic_irradiance")
                ? &report["error"]["caustic_irradiance"]
                : nullptr;
        if (error == nullptr || !error->contains("rel_mse") || !(*error)["rel_mse"].is_number())
            return std::nullopt;
        TunePoint point{one.mixture, one.side};
        if (error->contains("truth_noise") && (*error)["truth_noise"].contains("rel_mse") &&
            (*error)["truth_noise"]["rel_mse"].is_number())
            point.noise = (*error)["truth_noise"]["rel_mse"];
        point.error = std::max((*error)["rel_mse"].get<double>() - point.noise, 0.0);
        // As in all tables: not what the eye sees, direct light, and light in a medium.
        const std::set<std::string> others = {"eye",   "shadow", "compose", "view",
                                              "media", "blur",   "ledger"};
        for (const json& pass : report.at("passes")) {
            if (pass.at("ran").get<bool>() && others.count(pass.at("stage")) == 0)
                point.milliseconds += pass.at("gpu_ms").at("median").get<double>();
        }
        const json& frame = report.at("frame_ms");
        const double mean = frame.at("mean");
        if (mean > 0.0)
            point.deviation = point.milliseconds * frame.at("stdev").get<double>() / mean;
        return point;
    }

    const TuneOptions& options_;
    const Registry& registry_;
    TuneGoal goal_;
    std::vector<Mixture> mixtures_;
    fs::path out_;
    int round_ = 0;
    std::vector<TunePoint> points_;
    std::set<Wanted> asked_;
    std::set<std::size_t> failures_;
    std::string firstFailure_;
};

void check(const TuneOptions& options) {
    if (options.error.has_value() == options.milliseconds.has_value())
        throw ConfigError("tune: give --error, a relMSE, or --time, in ms; one of them.");
    if (options.error && !(*options.error > 0.0))
        throw ConfigError(fmt::format("--error: {:g} is not above 0.", *options.error));
    if (options.milliseconds && !(*options.milliseconds > 0.0))
        throw ConfigError(fmt::format("--time: {:g} ms is not above 0.", *options.milliseconds));
    if (options.referencePhotons < 1) {
        throw ConfigError(
            fmt::format("--reference-photons: {} is not above 0.", options.referencePhotons));
    }
    static_cast<void>(loadRequestedScene(options.scene, ""));
}

}  // namespace

void tuneCommand(const TuneOptions& options, const Registry& registry) {
    check(options);
    run::catchInterrupts();
    Tuning tuning(options, registry);
    run::requireWritable(tuning.out(), "--out");
    tuning.run();
    tuning.print();
    const TunePoint* best = tuning.best();
    if (best == nullptr) {
        const std::vector<TunePoint> front = frontOf(tuning.points());
        const TunePoint& nearest = options.error ? front.back() : front.front();
        throw Error(fmt::format("Nothing that was tried keeps to {}: the {} is relMSE {:.3g} in "
                                "{:.1f} ms.",
                                tuning.goalText(), options.error ? "least error" : "least time",
                                nearest.error, nearest.milliseconds),
                    kExitFailed);
    }
    if (options.error && *options.error < best->noise) {
        fmt::print(
            "warning: the reference's own noise is {:.2g}; more --reference-photons say more of "
            "errors below it.\n",
            best->noise);
    }
    const fs::path file = tuning.out() / "tuned.toml";
    writeFileWhole(file, tuning.settingsOf(*best));
    fmt::print("wrote {}; kaustik run {} --merge {}\n", file.string(), options.scene,
               file.string());
}

}  // namespace kaustik::app
