// SPDX-License-Identifier: MIT
// What frames of the session took, in runs of frames of the same settings, so that what a change
// has cost or saved is seen. Knows no window.
#pragma once

#include <string>
#include <vector>

#include "framework/gui/document.h"
#include "framework/gui/frame_result.h"
#include "framework/gui/table.h"

namespace kaustik::gui {

// The newest frames of one way to render, oldest first.
struct TimedRun {
    std::string scene;
    params::Extent size;
    Variant variant;
    std::string change;  // what differs from the run before: "emit.photons 64x64 → 128x128"
    std::vector<double> frameMs;
    std::vector<report::PassTimes> times;
};

class TimeHistory {
  public:
    // Takes what is new of one of the two variants. What moves in the scene, the camera and the
    // texture that is viewed change no settings.
    void note(const FrameResult& result, std::size_t variant);
    [[nodiscard]] const std::vector<TimedRun>& runs() const { return runs_; }
    static constexpr std::size_t kMaxRuns = 32;

  private:
    std::vector<TimedRun> runs_;
};

// What of the settings differs, a change after another: "exact_rays → umenhoffer_2008",
// "emit.photons default → 64x64", "shadow.bvh off".
[[nodiscard]] std::string changeBetween(const TimedRun& before, const TimedRun& after);

// Of the frame and every pass that either has, in ms: before, after, and the difference; those that
// differ most first. "–" where a pass has no time.
[[nodiscard]] Table timesBeforeAndAfter(const TimedRun& before, const TimedRun& after);

}  // namespace kaustik::gui
