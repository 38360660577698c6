// SPDX-License-Identifier: MIT
#include "framework/gl/timers.h"

#include <algorithm>
#include <utility>

namespace kaustik::gl {
namespace {
double milliseconds(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}
}  // namespace

void PassTimer::beginFrame(std::size_t passCount) {
    Slot& slot = ring_[frame_ % kFramesInFlight];
    if (slot.pending && !collect(slot, false)) {
        ++dropped_;
        slot.pending = false;
    }
    slot.time = FrameTime{frame_, 0.0, 0.0, std::vector<PassTime>(passCount)};
    slot.runs.clear();
    if (mode_ == TimerMode::finish) glFinish();
    slot.frameBegin = Clock::now();
}

void PassTimer::beginPass(std::size_t pass) {
    Slot& slot = ring_[frame_ % kFramesInFlight];
    slot.runs.push_back(pass);
    if (mode_ == TimerMode::timestamps) {
        while (slot.queries.size() < 2 * slot.runs.size())
            slot.queries.push_back(makeTimestampQuery());
    }
    slot.runBegin = Clock::now();
    if (mode_ == TimerMode::timestamps)
        glQueryCounter(slot.queries[2 * slot.runs.size() - 2].id(), GL_TIMESTAMP);
}

void PassTimer::endPass(std::size_t pass) {
    Slot& slot = ring_[frame_ % kFramesInFlight];
    PassTime& time = slot.time.passes[pass];
    time.cpuMs += milliseconds(Clock::now() - slot.runBegin);
    ++time.runs;
    if (mode_ == TimerMode::timestamps) {
        glQueryCounter(slot.queries[2 * slot.runs.size() - 1].id(), GL_TIMESTAMP);
        return;
    }
    glFinish();
    time.gpuMs += milliseconds(Clock::now() - slot.runBegin);
    if (time.runs == 1) time.startMs = milliseconds(slot.runBegin - slot.frameBegin);
}

void PassTimer::endFrame() {
    Slot& slot = ring_[frame_ % kFramesInFlight];
    double inPasses = 0.0;
    for (const PassTime& pass : slot.time.passes) {
        inPasses += mode_ == TimerMode::finish ? pass.gpuMs : pass.cpuMs;
    }
    const double total = milliseconds(Clock::now() - slot.frameBegin);
    slot.time.bookkeepingMs = std::max(0.0, total - inPasses);
    slot.time.frameMs = total;
    slot.pending = true;
    ++frame_;
}

bool PassTimer::collect(Slot& slot, bool wait) {
    FrameTime& time = slot.time;
    if (mode_ == TimerMode::timestamps && !slot.runs.empty()) {
        GLint available = GL_FALSE;
        glGetQueryObjectiv(slot.queries[2 * slot.runs.size() - 1].id(), GL_QUERY_RESULT_AVAILABLE,
                           &available);
        if (available != GL_TRUE && !wait) return false;
        const auto nanoseconds = [&](std::size_t query) {
            GLuint64 value = 0;
            glGetQueryObjectui64v(slot.queries[query].id(), GL_QUERY_RESULT, &value);
            return value;
        };
        const GLuint64 frameBegin = nanoseconds(0);
        GLuint64 frameEnd = frameBegin;
        for (PassTime& pass : time.passes)
            pass.runs = 0;
        for (std::size_t run = 0; run < slot.runs.size(); ++run) {
            const GLuint64 begin = nanoseconds(2 * run);
            // Clocks of different queues may disagree by a tick: never below zero.
            const GLuint64 end = std::max(nanoseconds(2 * run + 1), begin);
            frameEnd = std::max(frameEnd, end);
            PassTime& pass = time.passes[slot.runs[run]];
            pass.gpuMs += static_cast<double>(end - begin) * 1e-6;
            if (++pass.runs == 1) {
                pass.startMs = static_cast<double>(std::max(begin, frameBegin) - frameBegin) * 1e-6;
            }
        }
        time.frameMs = static_cast<double>(frameEnd - frameBegin) * 1e-6;
    }
    finished_.push_back(time);
    slot.pending = false;
    return true;
}

std::vector<FrameTime> PassTimer::takeFinished(bool wait) {
    for (std::size_t i = 0; i < kFramesInFlight; ++i) {
        Slot& slot = ring_[(frame_ + i) % kFramesInFlight];
        if (slot.pending && !collect(slot, wait)) break;
    }
    return std::exchange(finished_, {});
}

std::vector<FrameTime> PassTimer::takeBeforeNext() {
    Slot& oldest = ring_[frame_ % kFramesInFlight];
    if (oldest.pending) static_cast<void>(collect(oldest, true));
    return takeFinished();
}

double measuringMilliseconds(TimerMode mode) {
    constexpr std::size_t kPasses = 32;
    // In the first ones of the ring the queries are made.
    constexpr std::size_t kFirst = PassTimer::kFramesInFlight;
    constexpr std::size_t kFrames = 5;
    PassTimer timer(mode);
    std::vector<double> each;
    for (std::size_t frame = 0; frame < kFirst + kFrames; ++frame) {
        glFinish();
        const auto begin = std::chrono::steady_clock::now();
        timer.beginFrame(kPasses);
        for (std::size_t pass = 0; pass < kPasses; ++pass) {
            timer.beginPass(pass);
            timer.endPass(pass);
        }
        timer.endFrame();
        const auto taken = std::chrono::steady_clock::now() - begin;
        static_cast<void>(timer.takeFinished(true));
        if (frame >= kFirst) each.push_back(milliseconds(taken) / kPasses);
    }
    std::sort(each.begin(), each.end());
    return each[kFrames / 2];
}

}  // namespace kaustik::gl
