// SPDX-License-Identifier: MIT
// Every time of a run: by frame and pass, and as Chrome trace events.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "framework/report/run_report.h"
#include "framework/report/statistics.h"

namespace kaustik::report {

using nlohmann::json;

std::vector<double> frameSamples(const RunRecord& record) {
    std::vector<double> samples;
    for (const gl::FrameTime& frame : record.frames)
        samples.push_back(frame.frameMs);
    return samples;
}

std::vector<double> bookkeepingSamples(const RunRecord& record) {
    std::vector<double> samples;
    for (const gl::FrameTime& frame : record.frames)
        samples.push_back(frame.bookkeepingMs);
    return samples;
}

std::vector<PassTimes> timesByPass(const RunRecord& record) {
    std::vector<PassTimes> times;
    std::map<std::string, std::size_t> indexOf;
    for (const std::string& name : record.stepNames) {
        if (indexOf.emplace(name, times.size()).second) times.push_back({name, {}, {}});
    }
    for (const gl::FrameTime& frame : record.frames) {
        for (PassTimes& pass : times) {
            pass.gpuMilliseconds.push_back(0.0);
            pass.cpuMilliseconds.push_back(0.0);
        }
        for (std::size_t step = 0; step < frame.passes.size(); ++step) {
            PassTimes& pass = times[indexOf[record.stepNames[step]]];
            pass.gpuMilliseconds.back() += frame.passes[step].gpuMs;
            pass.cpuMilliseconds.back() += frame.passes[step].cpuMs;
        }
    }
    return times;
}

std::map<std::string, double> medianByPass(const RunRecord& record) {
    std::map<std::string, double> medians;
    for (const PassTimes& pass : timesByPass(record))
        medians.emplace(pass.name, summarize(pass.gpuMilliseconds).median);
    return medians;
}

json makeSamples(const RunRecord& record) {
    json passes = json::array();
    for (const PassTimes& pass : timesByPass(record)) {
        passes.push_back({{"name", pass.name},
                          {"gpu_ms", pass.gpuMilliseconds},
                          {"cpu_ms", pass.cpuMilliseconds}});
    }
    return {{"schema", "kaustik.samples/1"},
            {"frame_samples_ms", frameSamples(record)},
            {"bookkeeping_samples_ms", bookkeepingSamples(record)},
            {"passes", passes}};
}

namespace {

// A counter's events, one for each change; viewers draw a track for every value.
class Counter {
  public:
    Counter(json& events, std::string name) : events_(events), name_(std::move(name)) {}
    void set(double timeMs, json values) {
        if (values == last_) return;
        events_.push_back(
            {{"name", name_}, {"ph", "C"}, {"pid", 1}, {"ts", timeMs * 1e3}, {"args", values}});
        last_ = std::move(values);
    }

  private:
    json& events_;
    std::string name_;
    json last_;
};

}  // namespace

json makeChromeTrace(const RunRecord& record) {
    json events = json::array();
    Counter frameTimes(events, "time");
    Counter memory(events, "memory");
    Counter photons(events, "photons");
    double frameBegin = 0.0;
    const auto add = [&](const std::string& name, double startMs, double durationMs, int thread) {
        events.push_back({{"name", name},
                          {"ph", "X"},
                          {"pid", 1},
                          {"tid", thread},
                          {"ts", startMs * 1e3},
                          {"dur", durationMs * 1e3}});
    };
    for (const gl::FrameTime& frame : record.frames) {
        add(fmt::format("frame {}", frame.frame), frameBegin, frame.frameMs, 0);
        frameTimes.set(frameBegin,
                       {{"device_ms", frame.frameMs}, {"bookkeeping_ms", frame.bookkeepingMs}});
        // They are counted in a frame of their own, which repeats the last one.
        const bool hasLedger = !record.endedEarly || record.endedEarly->hasLedger;
        if (hasLedger && &frame == &record.frames.back())
            photons.set(frameBegin, photonsJson(record.ledger));
        for (std::size_t step = 0; step < frame.passes.size(); ++step) {
            const double begin = frameBegin + frame.passes[step].startMs;
            add(record.stepNames[step], begin, frame.passes[step].gpuMs, 1);
            const auto& [textures, buffers] = record.stepBytes[step];
            memory.set(begin, {{"texture_bytes", textures}, {"buffer_bytes", buffers}});
        }
        frameBegin += frame.frameMs;
    }
    return {{"traceEvents", events}, {"displayTimeUnit", "ms"}};
}

}  // namespace kaustik::report
