// SPDX-License-Identifier: MIT
#include "framework/gui/study_worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <system_error>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/shell_word.h"
#include "framework/experiment/process.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

// This very program, even when it is built anew meanwhile.
constexpr const char* kThisProgram = "/proc/self/exe";
constexpr std::chrono::milliseconds kTimeBetweenLooks{200};
constexpr const char* kPlanFile = "experiment.json";  // of a study's folder

json readJson(const fs::path& file) {
    return json::parse(readFile(file));
}

}  // namespace

std::optional<double> StudyRun::error(const std::string& measure) const {
    const auto found = errors.find(measure);
    if (found == errors.end() || !found->is_number()) return {};
    const auto value = found->get<double>();
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::size_t StudyState::finished() const {
    return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const auto& run) {
        return run.status != StudyRun::Status::waiting;
    }));
}

std::string resumeCommand(const StudyState& study) {
    return fmt::format("kaustik experiment run {} --out {} --resume", shellWord(study.experiment),
                       shellWord(study.folder.string()));
}

StudyWorker::StudyWorker(std::function<void()> onUpdate) : onUpdate_(std::move(onUpdate)) {}

StudyWorker::~StudyWorker() {
    cancel_ = true;
    if (thread_.joinable()) thread_.join();
}

std::shared_ptr<const StudyState> StudyWorker::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void StudyWorker::post() {
    {
        const std::lock_guard lock(mutex_);
        state_ = std::make_shared<const StudyState>(working_);
    }
    onUpdate_();
}

void StudyWorker::start(const Study& study, const ExperimentTerms& terms, const Registry& registry,
                        const fs::path& folder, const std::string& name) {
    if (state()->isRunning) return;
    if (thread_.joinable()) thread_.join();
    cancel_ = false;
    hashes_.clear();
    working_ = {};
    working_.isRunning = true;
    working_.study = study;
    working_.terms = terms;
    working_.folder = folder / name;
    for (Variant& variant : variantsOf(study))
        working_.runs.push_back({std::move(variant), StudyRun::Status::waiting, 0.0, {}, ""});
    post();
    thread_ = std::thread([this, &registry, folder, name] { run(registry, folder, name); });
}

void StudyWorker::cancel() {
    cancel_ = true;
}

void StudyWorker::run(const Registry& registry, fs::path folder, std::string name) {
    try {
        const std::vector<fs::path> files =
            writeStudy(working_.study, registry, folder, name, working_.terms);
        working_.experiment = files.front().string();
        post();
        Clock::time_point looked = Clock::now();
        const experiment::ProcessOutcome outcome = experiment::runProcess(
            kThisProgram,
            {"kaustik", "experiment", "run", working_.experiment,
             "--out=" + working_.folder.string()},
            experiment::StandardOutput::dropped,
            [&] {
                if (Clock::now() - looked >= kTimeBetweenLooks) {
                    looked = Clock::now();
                    if (gather()) post();
                }
                if (!cancel_) return false;
                working_.isEnding = true;
                post();
                return true;
            },
            SIGINT);
        gather();
        // Failed runs say so themselves, each in its row.
        const bool isWhole = working_.finished() == working_.runs.size();
        if (!outcome.interrupted && !isWhole) working_.problem = outcome.problem();
    } catch (const std::exception& error) {
        working_.problem = error.what();
    }
    std::error_code ignored;
    if (!hashes_.empty() && !fs::exists(working_.folder / kPlanFile, ignored)) {
        working_.problem =
            fmt::format("The folder {} was removed while the study ran, and its results with it.",
                        working_.folder.string());
    }
    working_.isRunning = false;
    working_.isEnding = false;
    post();
}

bool StudyWorker::gather() {
    std::error_code ignored;
    const fs::path file = working_.folder / kPlanFile;
    if (hashes_.empty()) {
        if (!fs::exists(file, ignored)) return false;
        const json plan = readJson(file);
        for (const json& run : plan.at("runs"))
            hashes_.push_back(run.at("hash").get<std::string>());
        if (hashes_.size() != working_.runs.size())
            throw IoError(file.string() + " has not the runs of this study.");
    }
    bool hasMore = false;
    for (std::size_t i = 0; i < hashes_.size(); ++i) {
        StudyRun& run = working_.runs[i];
        if (run.status != StudyRun::Status::waiting) continue;
        const fs::path folder = working_.folder / hashes_[i];
        const fs::path failure = working_.folder / (hashes_[i] + ".failed.json");
        if (fs::exists(folder / "run.json", ignored)) {
            const json report = readJson(folder / "report.json");
            run.status = StudyRun::Status::done;
            run.frameMs = report.at("frame_ms").at("median").get<double>();
            const json errors = report.value("error", json::object());
            if (errors.is_object()) run.errors = errors.value("caustic_irradiance", json());
            working_.runSeconds += readJson(folder / "run.json").at("wall_s").get<double>();
            hasMore = true;
        } else if (fs::exists(failure, ignored)) {
            run.status = StudyRun::Status::failed;
            run.message = readJson(failure).at("message").get<std::string>();
            hasMore = true;
        }
    }
    return hasMore;
}

}  // namespace kaustik::gui
