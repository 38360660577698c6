// SPDX-License-Identifier: MIT
// The workbench: a window, what is worked on in it, and the two threads that work.
#pragma once

#include <deque>
#include <filesystem>
#include <future>
#include <memory>
#include <string>

#include "framework/gui/bench.h"
#include "framework/gui/settings_file.h"
#include "framework/gui/window.h"
#include "framework/gui/workbench_options.h"

namespace kaustik::gui {

class Workbench {
  public:
    // Throws DeviceError where no window can be opened.
    Workbench(const Registry& registry, const WorkbenchOptions& options);
    ~Workbench();
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    // Runs until the window is closed. Throws DeviceError when the window's context is lost; what
    // was set up has been kept by then.
    void run();

  private:
    using Clock = std::chrono::steady_clock;
    void keep();
    void saveRegularly();
    void drawPixels();
    [[nodiscard]] std::shared_ptr<const FrameResult> labelled(
        std::shared_ptr<const FrameResult> latest);
    void pollWorkers();
    void takeDropped();
    void notePoints();
    void dropAbsentPasses();
    void saveExperimentOnceRendered();
    void submitChanges();
    [[nodiscard]] bool isAtWork();
    void aimReference();
    void draw();
    void drawToolbar();
    void drawStatusBar();
    void useKeys();
    void useKey(const Window::KeyPress& press);
    void useSign(unsigned character);
    void changeExposure(float stops);
    void pushUndo();
    void undo(int direction);
    void describe();
    void pollDifference();
    void pollPairs();
    void saveShown();
    void saveScreenshot();
    void finishScreenshot();
    void notifyWriting(const std::string& file);
    [[nodiscard]] double patience() const;

    const Registry& registry_;
    std::filesystem::path folder_;  // of settings; "" where nothing can be kept
    bool canSave_ = true;
    Settings settings_;
    Window window_;
    Canvas canvas_;
    ScreenMap map_;
    std::unique_ptr<RenderWorker> renderer_;
    ReferenceWorker referenceWorker_;
    StudyWorker studyWorker_;
    ThumbnailWorker thumbnailWorker_;
    Bench bench_;

    FrameOrder submitted_;
    bool hasSubmitted_ = false;
    std::shared_ptr<const FrameResult> relabelledOf_;  // with A and B exchanged
    std::shared_ptr<const FrameResult> relabelled_;
    std::uint64_t judgedOrder_ = 0;
    std::uint64_t judgedPhotons_ = 0;
    int judgedReloads_ = 0;
    std::uint64_t playedFrame_ = 0;
    std::deque<Document> history_;  // what was worked on before, the newest last
    std::size_t historyPlace_ = 0;
    std::string savedText_;
    Clock::time_point savedAt_;
    bool isUnattended_ = false;
    int framesToDraw_ = 3;
    Clock::time_point drawnAt_;
    int drawnFrame_ = 0;  // the newest whose pixels can be seen
    std::future<std::shared_ptr<const ImageDifference>> difference_;  // being computed
    std::future<std::shared_ptr<const Table>> pairs_;
    std::future<std::string> screenshot_;  // being written; why it failed, or nothing
    std::string written_;                  // the file of that
    Clock::time_point rendererBegin_;      // was started
    Clock::time_point frameBegin_;
    Clock::time_point turnedAt_;
    std::deque<double> interfaceMs_;  // what the newest frames of the interface took
};

}  // namespace kaustik::gui
