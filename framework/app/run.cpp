// SPDX-License-Identifier: MIT
// kaustik run: renders frames, times them, and writes pictures and the report.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/gl/capture.h"
#include "framework/image/tev_client.h"
#include "framework/report/limits.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"
#include "framework/run/run_record.h"
#include "framework/run/run_reference.h"
#include "framework/scene/shapes/height_field.h"

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
    if (!(std::abs(options.timeStepSeconds) <= 1e6)) {
        throw ConfigError(fmt::format("--time-step: {} is not from -1000000 to 1000000 seconds.",
                                      options.timeStepSeconds));
    }
    if (options.referencePhotons < 1) {
        throw ConfigError(
            fmt::format("--reference-photons: {} is not above 0.", options.referencePhotons));
    }
}

// The frames that are timed; warm-up frames run first, at the first one's time, and are not kept.
// `goTo` brings the scene to the time of a timed frame and builds the renderer for it; `rendered`
// is told when that frame is.
std::vector<gl::FrameTime> renderTimedFrames(Renderer& renderer, gl::PassTimer& timer,
                                             const RunOptions& options,
                                             const std::function<void(int frame)>& goTo,
                                             const std::function<void(int frame)>& rendered) {
    const int total = options.warmup + options.frames;
    std::vector<gl::FrameTime> times;
    run::Progress progress("frame", total);
    const auto take = [&](bool wait) {
        for (gl::FrameTime& frame : timer.takeFinished(wait))
            times.push_back(std::move(frame));
    };
    for (int frame = 0; frame < total; ++frame) {
        run::throwIfInterrupted();
        const int timed = std::max(frame - options.warmup, 0);
        if (options.timeStepSeconds != 0.0 && (frame == 0 || timed > 0)) {
            take(true);
            goTo(timed);
        }
        renderer.renderFrame(timer);
        // A ring slot is read when its frame is done; here, unlike in a window, no frame may be
        // lost, so the ring is emptied before it is full.
        take(timer.mode() == gl::TimerMode::finish || frame % 2 == 1);
        if (frame >= options.warmup) rendered(timed);
        progress.update(frame + 1);
    }
    take(true);
    const auto warm = static_cast<std::size_t>(options.warmup);
    times.erase(times.begin(),
                times.begin() + static_cast<std::ptrdiff_t>(std::min(times.size(), warm)));
    return times;
}

// Those of linear values, which a viewer of such pictures is for.
void showPictures(TevClient& viewer, const std::vector<fs::path>& files, const std::string& scene) {
    for (const fs::path& file : files) {
        if (file.extension() == floatImageExtension())
            viewer.show(fmt::format("{}/{}", scene, file.stem().string()), readImage(file));
    }
}

}  // namespace

void runCommand(const RunOptions& options, const Registry& registry) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    checkOptions(options);
    scene::Scene scene =
        loadRequestedScene(options.scene.scene, options.scene.time, options.scene.scenePlace);
    // Pictures, ledger and reference are the last frame's.
    const double firstTime = scene.timeSeconds;
    const auto timeOf = [&](int frame) { return firstTime + frame * options.timeStepSeconds; };
    if (options.timeStepSeconds != 0.0) scene::setTime(scene, timeOf(options.frames - 1));
    RenderSettings settings = makeSettings(options.scene, registry);
    settings.seed = static_cast<std::uint64_t>(options.seed);
    const fs::path folder =
        options.out.empty()
            ? fs::path("results/runs") / fmt::format("{}-{}", scene.name, settings.technique.name)
            : fs::path(options.out);

    if (options.captures) gl::requireRenderDoc();
    std::optional<TevClient> viewer;
    if (options.viewer) viewer.emplace(*options.viewer);

    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(options.scene.glDebug);
    Renderer renderer(*context, registry, scene, std::move(settings));
    renderer.build(Purpose::measurement, options.saved);  // finds every mistake before the work
    run::requireTextures(renderer, options.saved);
    renderer.build(Purpose::picture);
    run::requireWritable(folder, "--out");
    run::catchInterrupts();

    report::RunRecord record = run::startRecord(
        renderer, options.precise ? gl::TimerMode::finish : gl::TimerMode::timestamps);
    record.warmup = options.warmup;
    record.seed = options.seed;
    record.timeStepSeconds = options.timeStepSeconds;
    gl::PassTimer timer(record.timer);
    record.startupMilliseconds =
        std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    run::RunReference reference(options.reference,
                                static_cast<std::uint64_t>(options.referencePhotons),
                                renderer);  // before the frames: it may be refused
    const bool isInMotion = options.timeStepSeconds != 0.0 && renderer.needs().animated;
    if (isInMotion) {
        reference.watchFlicker(
            options.frames > 1 ? std::optional(timeOf(options.frames - 2)) : std::nullopt,
            renderer);
    }
    const auto goTo = [&](int frame) {
        scene::setTime(scene, timeOf(frame));
        renderer.update(RenderSettings(renderer.settings()));
        renderer.build(Purpose::picture);
    };
    // The picture's own frame repeats the last time, which a filter over time would count twice.
    const auto rendered = [&](int frame) {
        if (isInMotion && frame >= options.frames - 2) reference.keepMoment(renderer);
    };
    record.frames = renderTimedFrames(renderer, timer, options, goTo, rendered);

    std::vector<fs::path> files;
    if (options.captures) {
        gl::PassTimer untimed(gl::TimerMode::finish);
        files.push_back(gl::captureFrame(folder, [&] { renderer.renderFrame(untimed); }));
        record.warnings.emplace_back("RenderDoc was there, which takes time in every frame.");
    }
    const std::vector<fs::path> written =
        run::finishRun(renderer, reference, record, folder, options.saved, context->info());

    files.insert(files.begin(), written.begin(), written.end());
    if (viewer) showPictures(*viewer, written, scene.name);

    fmt::print("{} with {}, {}x{}, on {}{}\n", scene.name, renderer.settings().technique.name,
               renderer.settings().width, renderer.settings().height, context->info().renderer,
               context->info().debugs ? ", debugged" : "");
    fmt::print("{}", report::makeTable(record));
    for (const ReachedLimit& limit : report::reachedLimits(record, renderer))
        fmt::print("limit   {} = {:g}: {}\n", limit.parameter, limit.value, limit.sentence);
    for (const std::string& warning : record.warnings)
        fmt::print("warning: {}\n", warning);
    for (const fs::path& file : files)
        fmt::print("wrote {}\n", file.string());
}

}  // namespace kaustik::app
