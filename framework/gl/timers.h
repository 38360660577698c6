// SPDX-License-Identifier: MIT
// How long each pass takes: a pair of timestamp queries around it, in a ring of frames that is read
// only once the device is done with it (never waiting), or, for software rasterisers, wall time
// with the device finished around each pass.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "framework/gl/objects.h"

namespace kaustik::gl {

enum class TimerMode { timestamps, finish };

struct PassTime {  // of all runs of a frame together
    double gpuMs = 0.0;
    double cpuMs = 0.0;
    double startMs = 0.0;  // of the first, since the start of its frame
    int runs = 0;
};

struct FrameTime {
    std::size_t frame = 0;         // as counted by beginFrame
    double frameMs = 0.0;          // on the device, first pass begun to last pass ended
    double bookkeepingMs = 0.0;    // CPU time of the frame outside of the passes
    std::vector<PassTime> passes;  // in step order
};

class PassTimer {
  public:
    static constexpr std::size_t kFramesInFlight = 4;

    explicit PassTimer(TimerMode mode) : mode_(mode) {}
    [[nodiscard]] TimerMode mode() const { return mode_; }

    void beginFrame(std::size_t passCount);
    void beginPass(std::size_t pass);
    void endPass(std::size_t pass);
    void endFrame();

    // Frames whose times are known by now, in order; each is given once. `wait` waits for all.
    [[nodiscard]] std::vector<FrameTime> takeFinished(bool wait = false);
    // The same, and waits for the one frame whose place in the ring the next one takes: so that no
    // frame's time is lost, and as many as the ring has places for are under way.
    [[nodiscard]] std::vector<FrameTime> takeBeforeNext();
    // Frames whose ring slot was needed before the device had finished them: their times are lost.
    [[nodiscard]] std::size_t droppedFrames() const { return dropped_; }

  private:
    using Clock = std::chrono::steady_clock;
    struct Slot {
        bool pending = false;
        FrameTime time;
        std::vector<QueryObject> queries;  // two a run
        std::vector<std::size_t> runs;     // their passes; in a loop one has several
        Clock::time_point runBegin;
        Clock::time_point frameBegin;
    };
    [[nodiscard]] bool collect(Slot& slot, bool wait);

    TimerMode mode_;
    std::vector<Slot> ring_{kFramesInFlight};
    std::size_t frame_ = 0;
    std::size_t dropped_ = 0;
    std::vector<FrameTime> finished_;
};

// What timing a pass that does nothing takes, ms: the least that measuring adds to each pass. The
// median of a few frames; waits for the device.
[[nodiscard]] double measuringMilliseconds(TimerMode mode);

}  // namespace kaustik::gl
