// SPDX-License-Identifier: MIT
// A scene and settings that frames are rendered of, and what is known of these frames: the one way
// in which the command line, the workbench, Python and, by the command line, studies render, time
// and report. A session belongs to the thread that its context is current on.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/pipeline/renderer.h"
#include "framework/report/run_report.h"
#include "framework/run/program_account.h"
#include "framework/run/run_reference.h"

namespace kaustik::run {

// Frames that follow each other.
struct FrameSeries {
    int frames = 1;                           // that are timed
    int warmup = 0;                           // before these, at the first one's time; not timed
    std::optional<double> firstSeconds = {};  // time of the first timed frame; else the scene's
    double timeStepSeconds = 0.0;             // from one timed frame to the next

    // The time of a timed frame, counted from 0, of a scene that has this time now.
    [[nodiscard]] double secondsOf(int timedFrame, double sceneSeconds) const {
        return firstSeconds.value_or(sceneSeconds) + timedFrame * timeStepSeconds;
    }
};

// What the caller calls the series' numbers, for messages.
struct SeriesNames {
    const char* frames;
    const char* warmup;
    const char* timeStep;
};
// Throws ConfigError for numbers out of range.
void checkSeries(const FrameSeries& series, const SeriesNames& names);

// Asked before each pass, with its number among the graph's steps; false ends the frame there.
using ShouldContinue = std::function<bool(std::size_t step)>;

// Who looks on while a series is rendered.
struct SeriesWatch {
    ShouldContinue shouldContinue;
    std::function<void(int done)> onFrame;  // so many frames are done, those of the warm-up too
};

struct RenderedSeries {
    std::vector<gl::FrameTime> times;  // of the timed frames
    bool isWhole = true;               // false: it was ended early
};

// What a run leaves behind.
struct FinishedRun {
    report::RunRecord record;
    std::vector<std::filesystem::path> files;
};

struct SessionOptions {
    bool isPrecise = false;              // finishes the device around each pass
    std::size_t framesKept = 1'000'000;  // the newest, whose times are remembered
    // Disabled passes that no frame of the settings has are named by absentPasses() and left out;
    // else they are an error.
    bool leavesOutAbsentPasses = false;
};

class Session {
  public:
    // `context`, `registry` and `scene` outlive the session, which changes the scene's time.
    // Uploads the scene. Throws what Renderer does, as do all that prepare or render frames.
    Session(gl::Context& context, const Registry& registry, scene::Scene& scene,
            RenderSettings settings, SessionOptions options = {});

    // The settings as they were asked for; those of the renderer have full names of passes.
    [[nodiscard]] const RenderSettings& settings() const { return settings_; }
    // Other settings from the next frame on. Times of frames before are forgotten then.
    void change(RenderSettings settings);
    // Takes other settings over at once. Where they cannot be rendered, everything is as it was.
    void adopt(RenderSettings settings);
    // The scene is another one from the next frame on, in what Renderer::update() takes over.
    // Frames before are as good as those that follow and are timed with them, unless forgetTimes()
    // is called.
    void noteSceneChange();
    void setTime(double seconds);
    void forgetTimes();
    // Sets what SessionOptions::isPrecise says; what was timed in the other way is forgotten.
    void setPrecise(bool isPrecise);
    // Has frames keep these textures besides the outputs; those that the graph lacks are left out.
    void keep(std::set<std::string> textures);
    [[nodiscard]] std::vector<std::string> keptTextures() const;

    // Brings the renderer to the settings and the scene, built for pictures. Rendering does so.
    void prepare();
    // Finds every mistake before the work, also in the names of textures to be saved (--save).
    void check(const std::vector<std::string>& saved);
    // Renders only what the report's scene.needs asks for; notes it in the renderer's needs().
    void measureDepthComplexity();
    // Startup, of the report, began then and ends now.
    void noteStartup(std::chrono::steady_clock::time_point begin);

    // The reference that the series' last frame is judged by, and, where the scene moves from frame
    // to frame, the one before it. Goes to the last frame's time. `watch` as RunReference's.
    [[nodiscard]] RunReference referenceFor(const FrameSeries& series, const std::string& wanted,
                                            std::uint64_t photons, const Watch& watch = {});
    // Renders and times frames: the only loop over them. `reference`: what referenceFor() gave.
    // `saved`: what measure() or finish(), which must follow, will be asked for; then a series of
    // one frame is the one that they measure, and none is rendered for them.
    RenderedSeries render(const FrameSeries& series, const SeriesWatch& watch = {},
                          RunReference* reference = nullptr,
                          const std::vector<std::string>* saved = nullptr);
    // Whether the textures hold a whole frame of what was asked for last.
    [[nodiscard]] bool hasFrame() const { return hasFrame_; }
    // Renders the same frame once more, not timed. False: it was ended early.
    bool renderAgain(const ShouldContinue& shouldContinue = {});
    // A frame for another purpose and perhaps of another size, which is not timed; the next one is
    // as before. `kept`: textures that hold their contents after it.
    bool renderFor(Purpose purpose, const ShouldContinue& shouldContinue = {},
                   const std::optional<params::Extent>& size = {},
                   const std::vector<std::string>& kept = {});

    // What is known of the frames since something was changed, without what only a measurement
    // finds.
    [[nodiscard]] const report::RunRecord& record() const { return record_; }
    // The record with ledger, layers, limits and violations, after a frame for
    // Purpose::measurement.
    [[nodiscard]] report::RunRecord measured() const;
    // Renders one more frame at the last one's time, not timed (see render()), for ledger,
    // pictures, the textures `saved` and the reference's judgement, and completes the record but
    // for that. None where it was ended early.
    [[nodiscard]] std::optional<report::RunRecord> measure(
        const RunReference& reference, const std::vector<std::string>& saved,
        const ShouldContinue& shouldContinue = {});
    // Measures and judges as measure() does, and writes everything into `folder`: all of it or
    // nothing. Where the device is lost it throws what keepUnfinished() gives.
    [[nodiscard]] FinishedRun finish(const RunReference& reference,
                                     const std::filesystem::path& folder,
                                     const std::vector<std::string>& saved,
                                     const std::vector<std::string>& warnings = {});

    // Of a run that the device has left, lost or out of memory, what is known by now, as a run of
    // its own in the folder `unfinished` of `folder`: the report of the frames that were timed.
    // Gives the error with where that is and what it lacks: `alsoMissing` next to what finish()
    // adds. Other errors, and those before a frame was timed, keep nothing.
    [[nodiscard]] DeviceError keepUnfinished(
        const DeviceError& error, const std::filesystem::path& folder,
        const RunReference& reference, const std::vector<std::string>& alsoMissing = {}) const;

    // The programs of frames for pictures and for measurement, and which of them this device cannot
    // run. Renders nothing.
    [[nodiscard]] ProgramAccount accountPrograms();

    // Renders the frame once more with what each pass does to memory counted (gl::AccessCounter),
    // which the record then has. Not timed.
    void modelCost(const report::DeviceModel& model);

    [[nodiscard]] Renderer& renderer() { return renderer_; }
    [[nodiscard]] const Renderer& renderer() const { return renderer_; }
    // That the settings disable and that no frame of them has.
    [[nodiscard]] const std::vector<std::string>& absentPasses() const { return absentPasses_; }

  private:
    void update(const RenderSettings& settings);
    // Brings the renderer to the settings and the scene. `other` gives settings for what is
    // rendered next alone.
    void bringUpToDate(const RenderSettings* other = nullptr);
    void forgetBuild();
    // A frame that is timed and measured at once.
    struct MeasuredFrame {
        Purpose purpose;
        std::vector<std::string> saved;
        friend bool operator==(const MeasuredFrame&, const MeasuredFrame&) = default;
    };
    void prepareMeasured(const MeasuredFrame& wanted);
    void restartRecord();
    // What finish() has by the time that the device is lost.
    struct Done {
        report::RunRecord record;
        bool hasLedger = false;
        std::vector<std::filesystem::path> pictures;  // whole files, to be moved
    };
    [[nodiscard]] DeviceError keep(Done done, const DeviceError& error,
                                   const std::filesystem::path& folder,
                                   std::vector<std::string> missing) const;
    bool renderBuilt(gl::PassTimer& timer, const ShouldContinue& shouldContinue);
    bool renderUntimed(const ShouldContinue& shouldContinue);
    [[nodiscard]] double measuringMilliseconds();

    gl::Context& context_;
    scene::Scene& scene_;
    SessionOptions options_;
    RenderSettings settings_;
    Renderer renderer_;
    gl::PassTimer timer_;
    report::RunRecord record_;
    std::set<std::string> kept_;
    std::vector<std::string> absentPasses_;
    bool needsUpdate_;           // settings or scene are not the renderer's
    bool forgetsTimes_ = false;  // with the next update
    bool isBuilt_ = false;       // for pictures and what is kept
    bool hasFrame_ = false;
    std::optional<MeasuredFrame> measuredFrame_;   // the last one, until measure() takes it
    std::optional<double> measuringMilliseconds_;  // of a pass
};

}  // namespace kaustik::run
