// SPDX-License-Identifier: MIT
// kaustik run: renders frames, times them, and writes pictures and the report.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "framework/app/commands.h"
#include "framework/app/output.h"
#include "framework/app/progress.h"
#include "framework/app/truth.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/pipeline/stage_params.h"
#include "framework/report/limits.h"
#include "framework/report/run_report.h"

namespace kaustik::app {
namespace {
namespace fs = std::filesystem;

void checkOptions(const RunOptions& options) {
    if (options.frames < 1 || options.frames > 1000000) {
        throw ConfigError(fmt::format("--frames: {} is not from 1 to 1000000.", options.frames));
    }
    if (options.warmup < 0 || options.warmup > 1000000) {
        throw ConfigError(fmt::format("--warmup: {} is not from 0 to 1000000.", options.warmup));
    }
    if (options.referencePhotons < 1) {
        throw ConfigError(
            fmt::format("--reference-photons: {} is not above 0.", options.referencePhotons));
    }
}

// The frames that are timed; warm-up frames run first and are not kept.
std::vector<gl::FrameTime> renderTimedFrames(Renderer& renderer, gl::PassTimer& timer,
                                             const RunOptions& options) {
    const int total = options.warmup + options.frames;
    std::vector<gl::FrameTime> times;
    Progress progress("frame", total);
    const auto take = [&](bool wait) {
        for (gl::FrameTime& frame : timer.takeFinished(wait))
            times.push_back(std::move(frame));
    };
    for (int frame = 0; frame < total; ++frame) {
        throwIfInterrupted();
        renderer.renderFrame(timer);
        // A ring slot is read when its frame is done; here, unlike in a window, no frame may be
        // lost, so the ring is emptied before it is full.
        take(timer.mode() == gl::TimerMode::finish || frame % 2 == 1);
        progress.update(frame + 1);
    }
    take(true);
    const auto warm = static_cast<std::size_t>(options.warmup);
    times.erase(times.begin(),
                times.begin() + static_cast<std::ptrdiff_t>(std::min(times.size(), warm)));
    return times;
}

}  // namespace

void runCommand(const RunOptions& options, const Registry& registry) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    checkOptions(options);
    const scene::Scene scene = loadRequestedScene(options.scene.scene, options.scene.time);
    RenderSettings settings = makeSettings(options.scene, registry);
    const fs::path folder =
        options.out.empty()
            ? fs::path("results/runs") / fmt::format("{}-{}", scene.name, settings.technique.name)
            : fs::path(options.out);

    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless();
    Renderer renderer(*context, registry, scene, std::move(settings));
    renderer.build(Purpose::measurement, options.saved);  // finds every mistake before the work
    requireTextures(renderer, options.saved);
    renderer.build(Purpose::picture);
    requireWritable(folder);
    catchInterrupts();

    report::RunRecord record;
    record.timer = options.precise ? gl::TimerMode::finish : gl::TimerMode::timestamps;
    record.warmup = options.warmup;
    record.seed = options.seed;
    record.graphBuildMilliseconds = renderer.buildMilliseconds();
    record.passes = renderer.compiled().records;
    record.textureBytes = renderer.compiled().textureBytes;
    record.bufferBytes = renderer.compiled().bufferBytes;
    record.peakBytes = renderer.compiled().peakBytes;
    for (const graph::Step& step : renderer.compiled().steps) {
        record.stepNames.push_back(step.name);
    }
    gl::PassTimer timer(record.timer);
    record.startupMilliseconds =
        std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    const Truth truth(options.reference, static_cast<std::uint64_t>(options.referencePhotons),
                      renderer);  // before the frames: it may be refused
    record.frames = renderTimedFrames(renderer, timer, options);

    // The pictures come from one more frame, which also fills the ledger; it is not timed.
    renderer.build(truth.purpose(), options.saved);
    gl::PassTimer untimed(gl::TimerMode::finish);
    renderer.renderFrame(untimed);
    record.ledger = renderer.ledger();
    record.layers = renderer.layerStatistics();
    record.layersAllowed = renderer.outputs().layers.layers;
    record.nodeLimits = renderer.reachedLimits();
    record.warnings = scene.warnings;
    record.warnings.insert(record.warnings.end(), renderer.warnings().begin(),
                           renderer.warnings().end());
    for (const std::string& name : unusedSettings(renderer)) {
        record.warnings.push_back(
            fmt::format("{} was set, but no node of this run uses it.", name));
    }

    throwIfInterrupted();
    std::vector<fs::path> files = writePictures(folder, renderer, options.saved);
    const std::vector<fs::path> judged = truth.judge(renderer, folder, record);
    files.insert(files.end(), judged.begin(), judged.end());
    const std::vector<fs::path> seen = truth.judgeView(renderer, folder, record);
    files.insert(files.end(), seen.begin(), seen.end());
    writeFileWhole(folder / "trace.json", report::makeChromeTrace(record).dump());
    writeFileWhole(folder / "samples.json", report::makeSamples(record).dump());
    const nlohmann::json report = report::makeReport(record, renderer, context->info());
    writeFileWhole(folder / "report.json", report.dump(2) + "\n");

    fmt::print("{} with {}, {}x{}, on {}\n", scene.name, renderer.settings().technique.name,
               renderer.settings().width, renderer.settings().height, context->info().renderer);
    fmt::print("{}", report::makeTable(record));
    for (const ReachedLimit& limit : report::reachedLimits(record, renderer))
        fmt::print("limit   {} = {:g}: {}\n", limit.parameter, limit.value, limit.sentence);
    for (const std::string& warning : record.warnings)
        fmt::print("warning: {}\n", warning);
    for (const fs::path& file : files)
        fmt::print("wrote {}\n", file.string());
    for (const char* name : {"trace.json", "samples.json", "report.json"})
        fmt::print("wrote {}\n", (folder / name).string());
}

}  // namespace kaustik::app
