// SPDX-License-Identifier: MIT
#include "framework/run/session.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <utility>

#include "framework/core/elapsed.h"
#include "framework/core/error.h"
#include "framework/core/machine.h"
#include "framework/pipeline/stage_params.h"
#include "framework/run/output.h"
#include "framework/scene/emitters.h"
#include "framework/scene/shapes/height_field.h"
#include "framework/scene/spectrum.h"

namespace kaustik::run {
namespace {

gl::TimerMode timerMode(bool isPrecise) {
    return isPrecise ? gl::TimerMode::finish : gl::TimerMode::timestamps;
}

void checkCount(const char* name, int count, int minimum) {
    if (count < minimum || count > 1000000)
        throw ConfigError(fmt::format("{}: {} is not from {} to 1000000.", name, count, minimum));
}

// Two sessions may have one scene, with other points in the place of its lights, and other bands.
scene::Scene& withLightPoints(scene::Scene& scene, const RenderSettings& settings) {
    const auto& emit = settings.params.get<EmitParams>(EmitStage::name);
    if (!scene.emitters.empty()) scene::placeLightPoints(scene, emit.lightPoints, settings.height);
    scene::placeBands(scene, emit.wavelengths, settings.height,
                      static_cast<double>(emit.photons.width) * emit.photons.height);
    return scene;
}

// Leaves no more than the last `count`.
template <class T>
void keepLast(std::vector<T>& all, std::size_t count) {
    if (all.size() > count) all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(count));
}

}  // namespace

void checkSeries(const FrameSeries& series, const SeriesNames& names) {
    checkCount(names.frames, series.frames, 1);
    checkCount(names.warmup, series.warmup, 0);
    if (!(std::abs(series.timeStepSeconds) <= 1e6)) {
        throw ConfigError(fmt::format("{}: {} is not from -1000000 to 1000000 seconds.",
                                      names.timeStep, series.timeStepSeconds));
    }
}

Session::Session(gl::Context& context, const Registry& registry, scene::Scene& scene,
                 RenderSettings settings, SessionOptions options)
    : context_(context),
      scene_(scene),
      options_(options),
      settings_(std::move(settings)),
      renderer_(context, registry, withLightPoints(scene, settings_), settings_),
      timer_(timerMode(options.isPrecise)),
      needsUpdate_(options.leavesOutAbsentPasses) {}

void Session::change(RenderSettings settings) {
    settings_ = std::move(settings);
    noteSceneChange();
    forgetTimes();
}

void Session::adopt(RenderSettings settings) {
    const RenderSettings settingsBefore = settings_;
    const report::RunRecord recordBefore = record_;
    const bool neededUpdate = needsUpdate_;
    const bool forgotTimes = forgetsTimes_;
    change(std::move(settings));
    try {
        prepare();
    } catch (const Error&) {
        settings_ = settingsBefore;
        record_ = recordBefore;
        if (!neededUpdate) update(settings_);
        needsUpdate_ = neededUpdate;
        forgetsTimes_ = forgotTimes;
        forgetBuild();
        throw;
    }
}

void Session::noteSceneChange() {
    needsUpdate_ = true;
    hasFrame_ = false;
    measuredFrame_.reset();
}

void Session::setTime(double seconds) {
    if (seconds == scene_.timeSeconds) return;
    scene::setTime(scene_, seconds);
    noteSceneChange();
}

void Session::forgetTimes() {
    forgetsTimes_ = needsUpdate_ = true;
    measuredFrame_.reset();
}

void Session::setPrecise(bool isPrecise) {
    if (std::exchange(options_.isPrecise, isPrecise) == isPrecise) return;
    timer_ = gl::PassTimer(timerMode(isPrecise));
    measuringMilliseconds_.reset();
    record_.timer = timer_.mode();
    record_.frames.clear();
    record_.betweenFramesMilliseconds.clear();
}

void Session::keep(std::set<std::string> textures) {
    if (textures == kept_) return;
    kept_ = std::move(textures);
    forgetBuild();
}

std::vector<std::string> Session::keptTextures() const {
    std::vector<std::string> names(kept_.begin(), kept_.end());
    std::erase_if(names, [&](const std::string& name) { return !isTexture(renderer_, name); });
    return names;
}

void Session::forgetBuild() {
    isBuilt_ = hasFrame_ = false;
    measuredFrame_.reset();
}

void Session::update(const RenderSettings& settings) {
    withLightPoints(scene_, settings);
    renderer_.update(settings);
    if (options_.leavesOutAbsentPasses) absentPasses_ = renderer_.forgetAbsentPasses();
}

void Session::bringUpToDate(const RenderSettings* other) {
    if (!needsUpdate_ && other == nullptr) return;
    forgetBuild();
    needsUpdate_ = true;
    update(other != nullptr ? *other : settings_);
    needsUpdate_ = other != nullptr;
    if (!std::exchange(forgetsTimes_, false)) return;
    record_.frames.clear();
    record_.betweenFramesMilliseconds.clear();
    record_.warmup = 0;
}

void Session::prepare() {
    bringUpToDate();
    if (isBuilt_) return;
    forgetBuild();
    renderer_.build(Purpose::picture);
    // What is kept may not be in the graph of other settings.
    const std::vector<std::string> kept = keptTextures();
    if (!kept.empty()) renderer_.build(Purpose::picture, kept);
    isBuilt_ = true;
    restartRecord();
}

void Session::prepareMeasured(const MeasuredFrame& wanted) {
    bringUpToDate();
    forgetBuild();
    renderer_.build(wanted.purpose, wanted.saved);
    restartRecord();
}

// Describes the graph that is built. Times of frames of the same passes stay.
void Session::restartRecord() {
    report::RunRecord now;
    now.timer = timer_.mode();
    now.timing.hasLedger = settings_.hasLedger;
    now.seed = static_cast<long long>(settings_.seed);
    now.timeStepSeconds = record_.timeStepSeconds;
    now.startupMilliseconds = record_.startupMilliseconds;
    now.graphBuildMilliseconds = renderer_.buildMilliseconds();
    const graph::Compiled& compiled = renderer_.compiled();
    now.passes = compiled.records;
    now.textureBytes = compiled.textureBytes;
    now.bufferBytes = compiled.bufferBytes;
    now.peakBytes = compiled.peakBytes;
    for (const graph::Step& step : compiled.steps) {
        now.stepNames.push_back(step.name);
        now.stepBytes.emplace_back(step.liveTextureBytes, step.liveBufferBytes);
    }
    if (now.stepNames == record_.stepNames) {
        now.frames = std::move(record_.frames);
        now.betweenFramesMilliseconds = std::move(record_.betweenFramesMilliseconds);
        now.timing = record_.timing;
        now.warmup = record_.warmup;
    }
    record_ = std::move(now);
}

void Session::check(const std::vector<std::string>& saved) {
    bringUpToDate();
    forgetBuild();
    renderer_.build(Purpose::measurement, saved);
    requireTextures(renderer_, saved);
}

void Session::measureDepthComplexity() {
    bringUpToDate();
    forgetBuild();
    renderer_.measureDepthComplexity();
}

void Session::noteStartup(std::chrono::steady_clock::time_point begin) {
    record_.startupMilliseconds = millisecondsSince(begin);
}

RunReference Session::referenceFor(const FrameSeries& series, const std::string& wanted,
                                   std::uint64_t photons, const Watch& watch) {
    const double begin = scene_.timeSeconds;
    setTime(series.secondsOf(series.frames - 1, begin));
    prepare();
    RunReference reference(wanted, photons, renderer_, watch);
    if (series.timeStepSeconds != 0.0 && renderer_.needs().animated) {
        const bool hasTwoTimes = series.frames > 1;
        reference.watchFlicker(
            hasTwoTimes ? std::optional(series.secondsOf(series.frames - 2, begin)) : std::nullopt,
            renderer_);
    }
    return reference;
}

bool Session::renderBuilt(gl::PassTimer& timer, const ShouldContinue& shouldContinue) {
    hasFrame_ = false;
    hasFrame_ = renderer_.renderFrame(timer, shouldContinue);
    return hasFrame_;
}

bool Session::renderUntimed(const ShouldContinue& shouldContinue) {
    gl::PassTimer untimed(gl::TimerMode::finish);
    return renderBuilt(untimed, shouldContinue);
}

RenderedSeries Session::render(const FrameSeries& series, const SeriesWatch& watch,
                               RunReference* reference, const std::vector<std::string>* saved) {
    RenderedSeries rendered;
    const auto add = [&](std::vector<gl::FrameTime> times) {
        if (times.empty()) return;
        // Of a device that was lost meanwhile they say nothing.
        context_.setScope("after a frame");
        context_.check();
        std::move(times.begin(), times.end(), std::back_inserter(rendered.times));
    };
    const double begin = scene_.timeSeconds;
    const int total = series.warmup + series.frames;
    record_.timeStepSeconds = series.timeStepSeconds;
    static_cast<void>(timer_.takeFinished(true));  // of a series that an error has ended
    static_cast<void>(renderer_.executor().takeCutShort(true));
    const std::size_t droppedBefore = timer_.droppedFrames();
    std::optional<ProcessorTimes> processors;
    std::string date;
    const auto note = [&] {
        const auto warm = std::min(rendered.times.size(), static_cast<std::size_t>(series.warmup));
        rendered.times.erase(rendered.times.begin(),
                             rendered.times.begin() + static_cast<std::ptrdiff_t>(warm));
        record_.warmup += static_cast<int>(warm);
        std::vector<gl::FrameTime>& all = record_.frames;
        all.insert(all.end(), rendered.times.begin(), rendered.times.end());
        keepLast(all, options_.framesKept);
        keepLast(record_.betweenFramesMilliseconds, options_.framesKept);
        if (date.empty()) return;
        record_.timing = {.date = date,
                          .otherProcessors = otherProcessors(processors, processorTimes()),
                          .droppedFrames = timer_.droppedFrames() - droppedBefore,
                          .isOfMeasuredFrame = measuredFrame_.has_value(),
                          .hasLedger = settings_.hasLedger || measuredFrame_.has_value()};
    };
    try {
        for (int frame = 0; frame < total; ++frame) {
            const double seconds = series.secondsOf(std::max(frame - series.warmup, 0), begin);
            if (seconds != scene_.timeSeconds) add(timer_.takeFinished(true));
            const bool moves = frame > series.warmup && renderer_.needs().animated &&
                               seconds != scene_.timeSeconds;
            const auto frameBefore = std::chrono::steady_clock::now();
            setTime(seconds);
            std::optional<MeasuredFrame> measured;
            if (total == 1 && reference != nullptr && saved != nullptr)
                measured = MeasuredFrame{reference->purpose(), *saved};
            if (measured) {
                prepareMeasured(*measured);
            } else {
                prepare();
            }
            if (moves) record_.betweenFramesMilliseconds.push_back(millisecondsSince(frameBefore));
            if (frame == series.warmup) {
                processors = processorTimes();
                date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
            }
            rendered.isWhole = renderBuilt(timer_, watch.shouldContinue);
            if (!rendered.isWhole) break;
            measuredFrame_ = std::move(measured);
            add(options_.isPrecise ? timer_.takeFinished(true) : timer_.takeBeforeNext());
            // The picture's own frame repeats the last time, which a filter over time would count
            // twice.
            const bool isOfLastTwo = frame >= series.warmup && frame >= total - 2;
            if (reference != nullptr && isOfLastTwo) reference->recordMoment(renderer_);
            if (watch.onFrame) watch.onFrame(frame + 1);
        }
        add(timer_.takeFinished(true));
    } catch (const DeviceError&) {
        note();
        throw;
    }
    note();
    if (!date.empty()) {
        record_.timing.cutShortFrames = renderer_.executor().takeCutShort(true);
        record_.timing.measuringMilliseconds = measuringMilliseconds();
    }
    return rendered;
}

// Of a frame with as many runs of passes as the last one that was timed.
double Session::measuringMilliseconds() {
    if (record_.frames.empty()) return 0.0;
    if (!measuringMilliseconds_) measuringMilliseconds_ = gl::measuringMilliseconds(timer_.mode());
    int runs = 0;
    for (const gl::PassTime& pass : record_.frames.back().passes)
        runs += pass.runs;
    return runs * *measuringMilliseconds_;
}

bool Session::renderAgain(const ShouldContinue& shouldContinue) {
    prepare();
    return renderUntimed(shouldContinue);
}

ProgramAccount Session::accountPrograms() {
    ProgramAccount account;
    bringUpToDate();
    for (const Purpose purpose : {Purpose::picture, Purpose::measurement}) {
        forgetBuild();
        renderer_.build(purpose);
        account.add(renderer_);
    }
    forgetBuild();
    return account;
}

void Session::modelCost(const report::DeviceModel& model) {
    prepare();
    gl::AccessCounter counter(renderer_.programs());
    renderer_.executor().countAccesses(&counter);
    try {
        renderUntimed({});
    } catch (...) {
        renderer_.executor().countAccesses(nullptr);
        throw;
    }
    renderer_.executor().countAccesses(nullptr);
    record_.cost = report::FrameCost{model, counter.take()};
}

bool Session::renderFor(Purpose purpose, const ShouldContinue& shouldContinue,
                        const std::optional<params::Extent>& size,
                        const std::vector<std::string>& kept) {
    if (size) {
        RenderSettings other = settings_;
        other.width = size->width;
        other.height = size->height;
        bringUpToDate(&other);
    } else {
        bringUpToDate();
    }
    forgetBuild();
    renderer_.build(purpose, kept);
    const bool isWhole = renderUntimed(shouldContinue);
    hasFrame_ = false;  // of what was asked for
    return isWhole;
}

}  // namespace kaustik::run
