// SPDX-License-Identifier: MIT
// A study in the background: `kaustik experiment run` in a process of its own does it, as it would
// from a shell, and what its folder has of finished runs comes back while it goes on.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "framework/gui/experiment_file.h"
#include "framework/gui/study.h"

namespace kaustik::gui {

struct StudyRun {
    enum class Status { waiting, done, failed };
    Variant variant;
    Status status = Status::waiting;
    double frameMs = 0.0;   // median
    nlohmann::json errors;  // of the caustic irradiance, by the report's keys; null without any
    std::string message;    // why it failed
    // None where it was not judged by this measure.
    [[nodiscard]] std::optional<double> error(const std::string& measure) const;
};

struct StudyState {
    bool isRunning = false;
    bool isEnding = false;         // was told to stop
    std::string problem;           // why there are no more runs; "" where all is well
    std::string experiment;        // the file that `kaustik experiment run` takes
    std::filesystem::path folder;  // of the results
    Study study;
    ExperimentTerms terms;
    std::vector<StudyRun> runs;  // of variantsOf(study)
    double runSeconds = 0.0;     // what all that are finished took
    [[nodiscard]] std::size_t finished() const;
};

// For a shell: does the runs that a study has not done.
[[nodiscard]] std::string resumeCommand(const StudyState& study);

class StudyWorker {
  public:
    // `onUpdate` is called on the worker's thread.
    explicit StudyWorker(std::function<void()> onUpdate);
    ~StudyWorker();  // ends the run at hand; what is finished stays in its folder
    StudyWorker(const StudyWorker&) = delete;
    StudyWorker& operator=(const StudyWorker&) = delete;

    // Writes the study as NAME.toml into `folder`, and its results into the folder NAME there.
    // Nothing while another one is running.
    void start(const Study& study, const ExperimentTerms& terms, const Registry& registry,
               const std::filesystem::path& folder, const std::string& name);
    // Ends it after what is finished: `kaustik experiment run … --resume` does the rest.
    void cancel();
    // Never null; without runs before the first study.
    [[nodiscard]] std::shared_ptr<const StudyState> state() const;

  private:
    void run(const Registry& registry, std::filesystem::path folder, std::string name);
    // Takes up what the folder has of runs that are finished; true where there is more than before.
    bool gather();
    void post();

    std::function<void()> onUpdate_;
    std::atomic<bool> cancel_{false};
    mutable std::mutex mutex_;
    std::shared_ptr<const StudyState> state_ = std::make_shared<const StudyState>();
    StudyState working_;               // the thread's own while it runs
    std::vector<std::string> hashes_;  // of the runs, once the study's folder has them
    std::thread thread_;
};

}  // namespace kaustik::gui
