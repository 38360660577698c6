// SPDX-License-Identifier: MIT
#include "framework/python/session_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/report/statistics.h"
#include "framework/run/output.h"
#include "framework/run/run_record.h"
#include "framework/run/run_reference.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::python {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

// Times of so many frames are remembered.
constexpr std::size_t kMostFrames = 100000;

RenderSettings makeSettings(const SessionOptions& options) {
    RenderSettings settings;
    settings.technique = registry().findTechnique(options.technique);
    settings.params = registry().makeParams(settings.technique);
    for (const auto& [name, value] : options.settings)
        settings.params.set(name, value, "set");
    setSize(settings, options.size);
    settings.disabledPasses.insert(options.disabled.begin(), options.disabled.end());
    settings.seed = options.seed;
    return settings;
}

void checkTime(double seconds) {
    if (std::abs(seconds) <= 1e9) return;
    throw ConfigError(
        fmt::format("time: {} is not from -1000000000 to 1000000000 seconds.", seconds));
}

// A folder for pictures that nobody asked for.
struct TemporaryFolder {
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "kaustik-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw IoError(fmt::format("The folder {} cannot be made.", name));
        path = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    fs::path path;
};

run::Watch watchOf(const WorkThread::GoesOn& goesOn) {
    return {goesOn, [](double, const std::string&) {}};
}

}  // namespace

void setSize(RenderSettings& settings, const std::string& text) {
    params::Extent size;
    params::Field{"size", "", "px", &size, 1.0, 16384.0, {}}.set(text, "size", "open");
    settings.width = size.width;
    settings.height = size.height;
}

json timesOf(const report::RunRecord& record) {
    std::vector<double> frames;
    for (const gl::FrameTime& frame : record.frames)
        frames.push_back(frame.frameMs);
    json passes = json::array();
    for (const report::PassTimes& pass : report::timesByPass(record)) {
        passes.push_back({{"name", pass.name},
                          {"gpu_ms", toJson(report::summarize(pass.gpuMilliseconds))},
                          {"cpu_ms", toJson(report::summarize(pass.cpuMilliseconds))}});
    }
    return {{"frames", record.frames.size()},
            {"frame_ms", toJson(report::summarize(std::move(frames)))},
            {"passes", std::move(passes)}};
}

Session::Device::Device(scene::Scene loaded, const SessionOptions& options)
    : scene(std::move(loaded)), settings(makeSettings(options)) {
    const Clock::time_point begin = Clock::now();
    if (options.time) {
        checkTime(*options.time);
        scene::setTime(scene, *options.time);
    }
    context = gl::Context::createHeadless(options.debugs, options.device);
    renderer = std::make_unique<Renderer>(*context, registry(), scene, settings);
    timer = std::make_unique<gl::PassTimer>(options.isPrecise ? gl::TimerMode::finish
                                                              : gl::TimerMode::timestamps);
    prepare();
    record.startupMilliseconds =
        std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

void Session::Device::prepare() {
    if (!isChanged && isBuilt) return;
    forgetBuild();
    if (isChanged) {
        renderer->update(settings);
        record.frames.clear();
        record.warmup = 0;
    }
    isChanged = true;  // until all is well
    renderer->build(Purpose::picture);
    // Other settings may not have what was read before.
    std::erase_if(kept,
                  [&](const std::string& name) { return !renderer->graph().find(name).valid(); });
    if (!kept.empty()) renderer->build(Purpose::picture, {kept.begin(), kept.end()});
    isChanged = false;
    isBuilt = true;

    report::RunRecord now = run::startRecord(*renderer, timer->mode());
    now.startupMilliseconds = record.startupMilliseconds;
    now.seed = static_cast<long long>(settings.seed);
    now.timeStepSeconds = record.timeStepSeconds;
    if (now.stepNames == record.stepNames) {
        now.frames = std::move(record.frames);
        now.warmup = record.warmup;
    }
    record = std::move(now);
}

void Session::Device::adopt(RenderSettings wanted) {
    const RenderSettings before = std::exchange(settings, std::move(wanted));
    const report::RunRecord recordBefore = record;
    const bool wasChanged = std::exchange(isChanged, true);
    try {
        prepare();
        isStale = true;
    } catch (const Error&) {
        settings = before;
        record = recordBefore;
        isChanged = wasChanged;
        if (!wasChanged) renderer->update(settings);
        forgetBuild();
        throw;
    }
}

void Session::Device::render(const GoesOn& goesOn) {
    hasFrame = false;
    if (!renderer->renderFrame(*timer, [&](std::size_t) { return goesOn(); })) throw Stopped();
    hasFrame = true;
    hasStepped = true;
    isStale = false;
}

void Session::Device::requireFrame(const GoesOn& goesOn) {
    if (!hasStepped) throw ConfigError("No frame has been rendered yet; step() renders one.");
    if (isStale)
        throw ConfigError("Something was changed after the last frame; step() renders it.");
    if (hasFrame) return;
    prepare();
    gl::PassTimer untimed(gl::TimerMode::finish);
    if (!renderer->renderFrame(untimed, [&](std::size_t) { return goesOn(); })) throw Stopped();
    hasFrame = true;
}

graph::ResourceRef Session::Device::requireTexture(const std::string& name, const GoesOn& goesOn) {
    requireFrame(goesOn);
    const graph::Graph& graph = renderer->graph();
    const graph::ResourceRef handle = graph.find(name);
    if (!handle.valid()) {
        throw ConfigError(fmt::format("There is no resource '{}'{}; resources() lists them all.",
                                      name, didYouMean(name, graph.resourceNames())));
    }
    if (!std::holds_alternative<graph::TextureDesc>(graph.descOf(handle))) {
        throw ConfigError(fmt::format(
            "'{}' is a buffer, and only textures can be read (resources() says which those are).",
            name));
    }
    const FrameOutputs& outputs = renderer->outputs();
    for (const graph::ResourceRef& always : std::initializer_list<graph::ResourceRef>{
             outputs.picture.radiance, outputs.picture.display, outputs.caustic.irradiance,
             outputs.caustic.radiance, outputs.inScattered.radiance}) {
        if (handle == always) return handle;
    }
    if (kept.insert(name).second) {
        forgetBuild();
        requireFrame(goesOn);
    }
    return renderer->graph().find(name);
}

void Session::Device::goToTime(double seconds) {
    checkTime(seconds);
    if (seconds == scene.timeSeconds) return;
    scene::setTime(scene, seconds);
    forgetBuild();
    // The frames before are as good as those that follow: they are timed together.
    if (!isChanged) renderer->update(settings);
}

json Session::Device::step(const StepRequest& request, const GoesOn& goesOn) {
    if (request.frames < 1 || request.frames > 1000000)
        throw ConfigError(fmt::format("n: {} is not from 1 to 1000000.", request.frames));
    if (request.warmup < 0 || request.warmup > 1000000)
        throw ConfigError(fmt::format("warmup: {} is not from 0 to 1000000.", request.warmup));
    if (!(std::abs(request.timeStep) <= 1e6)) {
        throw ConfigError(fmt::format("time_step: {} is not from -1000000 to 1000000 seconds.",
                                      request.timeStep));
    }
    record.timeStepSeconds = request.timeStep;
    static_cast<void>(timer->takeFinished(true));  // of a step that was stopped
    const double first =
        request.time.value_or(scene.timeSeconds + (hasStepped ? request.timeStep : 0.0));
    std::vector<gl::FrameTime> times;
    const auto take = [&](bool wait) {
        for (gl::FrameTime& frame : timer->takeFinished(wait))
            times.push_back(std::move(frame));
    };
    const auto keepTimes = [&] {
        take(true);
        const auto warm = static_cast<std::ptrdiff_t>(
            std::min(times.size(), static_cast<std::size_t>(request.warmup)));
        times.erase(times.begin(), times.begin() + warm);
        record.warmup += static_cast<int>(warm);
        record.frames.insert(record.frames.end(), times.begin(), times.end());
        if (record.frames.size() > kMostFrames) {
            record.frames.erase(record.frames.begin(),
                                record.frames.end() - static_cast<std::ptrdiff_t>(kMostFrames));
        }
    };
    for (int frame = 0; frame < request.warmup + request.frames; ++frame) {
        if (request.timeStep != 0.0) take(true);
        goToTime(first + std::max(frame - request.warmup, 0) * request.timeStep);
        prepare();
        try {
            render(goesOn);
        } catch (const Stopped&) {
            keepTimes();
            throw;
        }
        take(timer->mode() == gl::TimerMode::finish || frame % 2 == 1);
    }
    keepTimes();
    report::RunRecord these = record;
    these.frames = std::move(times);
    return timesOf(these);
}

json Session::Device::report(const Judgement& judgement, const GoesOn& goesOn) {
    requireFrame(goesOn);
    prepare();
    const run::RunReference reference(judgement.reference, judgement.photons, *renderer,
                                      watchOf(goesOn));
    report::RunRecord finished = record;
    forgetBuild();
    const bool isWhole = run::measureRun(*renderer, reference, finished, {kept.begin(), kept.end()},
                                         [&](std::size_t) { return goesOn(); });
    if (!isWhole) throw Stopped();
    if (reference.purpose() == Purpose::audit) {
        const TemporaryFolder pictures;
        static_cast<void>(reference.judge(*renderer, pictures.path, finished));
        static_cast<void>(reference.judgeView(*renderer, pictures.path, finished));
    } else {
        hasFrame = true;  // with all that is kept
    }
    return report::makeReport(finished, *renderer, context->info());
}

std::vector<fs::path> Session::Device::save(const fs::path& folder,
                                            const std::vector<std::string>& resources,
                                            const Judgement& judgement, const GoesOn& goesOn) {
    for (const std::string& name : resources)
        static_cast<void>(requireTexture(name, goesOn));
    requireFrame(goesOn);
    prepare();
    run::requireWritable(folder, "folder");
    const run::RunReference reference(judgement.reference, judgement.photons, *renderer,
                                      watchOf(goesOn));
    report::RunRecord finished = record;
    forgetBuild();
    return run::finishRun(*renderer, reference, finished, folder, resources, context->info());
}

}  // namespace kaustik::python
