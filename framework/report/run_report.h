// SPDX-License-Identifier: MIT
// What a run found out, as report.json (schema kaustik.report/1; framework/README.md, "The
// report"), as a table for people, and as Chrome trace events.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/gl/context.h"
#include "framework/gl/timers.h"
#include "framework/pipeline/renderer.h"
#include "framework/report/device_model.h"
#include "framework/report/map_account.h"

namespace kaustik::report {

// Of the last timed frames.
struct Timing {
    std::string date;                       // when they began, UTC: 2026-11-25T18:40:00Z
    std::optional<double> otherProcessors;  // that other work kept busy, on average
    // That were rendered but whose times the device did not give in time: not among the samples.
    std::size_t droppedFrames = 0;
    double measuringMilliseconds = 0.0;  // of a frame: its passes by gl::measuringMilliseconds
    // That were left before a loop's end (gl::Executor::takeCutShort): among the samples.
    std::size_t cutShortFrames = 0;
    bool isOfMeasuredFrame = false;  // with all that only a measurement asks for
    bool hasLedger = true;           // whether they summed up the energy ledger
};

// Of a run that an error has ended before it was judged.
struct EndedEarly {
    std::string why;
    std::vector<std::string> missing;  // of what it was to leave behind
    bool hasLedger = false;            // and what else a frame for Purpose::measurement tells
};

// Everything but the times and the ledger is read from the renderer.
struct RunRecord {
    gl::TimerMode timer = gl::TimerMode::timestamps;
    std::vector<std::string> stepNames;                          // of the timed graph
    std::vector<std::pair<std::size_t, std::size_t>> stepBytes;  // textures, buffers in use in them
    std::vector<graph::PassRecord> passes;                       // of the timed graph
    std::vector<gl::FrameTime> frames;                           // timed ones only
    // The processor's, to bring a scene that moves from one timed frame's time to the next one's.
    std::vector<double> betweenFramesMilliseconds;
    Timing timing;  // of these
    int warmup = 0;
    long long seed = 1;
    double timeStepSeconds = 0.0;  // between timed frames
    double startupMilliseconds = 0.0;
    double graphBuildMilliseconds = 0.0;
    EnergyLedger ledger;
    PrimitiveFlux primitives;
    std::optional<EyeRays> eyeRays;  // none where none is followed
    transport::LayerStatistics layers;
    int layersAllowed = 0;
    std::vector<ReachedLimit> nodeLimits;  // that nodes keep to; the report has all
    std::size_t textureBytes = 0;
    std::size_t bufferBytes = 0;
    std::size_t peakBytes = 0;
    bool photonsEnd = false;        // ModelledPaths::end
    std::optional<FrameCost> cost;  // none where it was not asked for
    nlohmann::json map;             // mapAccount
    nlohmann::json cells;           // cellAccount
    nlohmann::json hits;            // null where no reference was asked for, as is the next
    nlohmann::json error;           //
    nlohmann::json unformed;        // null where no census of the scene's paths is at hand
    std::vector<std::string> warnings;
    std::vector<std::string> violations;   // report/violations.h
    std::optional<EndedEarly> endedEarly;  // none where it came to its end
};

// The times of one pass, its repeats in a frame added up.
struct PassTimes {
    std::string name;
    std::vector<double> gpuMilliseconds;  // by frame
    std::vector<double> cpuMilliseconds;
};
[[nodiscard]] std::vector<PassTimes> timesByPass(const RunRecord& record);

// Median of each pass on the device, ms, by name.
[[nodiscard]] std::map<std::string, double> medianByPass(const RunRecord& record);

// Milliseconds, by frame.
[[nodiscard]] std::vector<double> frameSamples(const RunRecord& record);
[[nodiscard]] std::vector<double> bookkeepingSamples(const RunRecord& record);

// scene.needs of the report. `depthComplexity`: surfaces along a pixel's ray, at most.
[[nodiscard]] nlohmann::json needsJson(const scene::SceneNeeds& needs, long long depthComplexity);

// `photons` of the report.
[[nodiscard]] nlohmann::json photonsJson(const EnergyLedger& ledger);

[[nodiscard]] nlohmann::json makeReport(const RunRecord& record, const Renderer& renderer,
                                        const gl::DeviceInfo& device);

// The JSON Schema of makeReport's. `judgements`: of `hits` and `error`, which whoever compares a
// run with a reference writes.
[[nodiscard]] nlohmann::json reportSchema(const std::map<std::string, nlohmann::json>& judgements);

// Median per pass, share of the frame, what was skipped and why, and the ledger.
[[nodiscard]] std::string makeTable(const RunRecord& record);

// Every time behind the report's statistics (schema kaustik.samples/1).
[[nodiscard]] nlohmann::json makeSamples(const RunRecord& record);

// Complete events of every pass and frame and counters (times, memory by pass, photons), for
// chrome://tracing and Perfetto.
[[nodiscard]] nlohmann::json makeChromeTrace(const RunRecord& record);

}  // namespace kaustik::report
