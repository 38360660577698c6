// SPDX-License-Identifier: MIT
#include "framework/python/session_device.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/json_schema.h"
#include "framework/core/names.h"
#include "framework/report/statistics.h"
#include "framework/run/output.h"
#include "framework/run/settings.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::python {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Times of so many frames are remembered.
constexpr std::size_t kFrameHistory = 100000;

RenderSettings makeSettings(const SessionOptions& options) {
    RenderSettings settings =
        run::makeSettings({.technique = options.technique,
                           .assignments = assignmentsOf(options.settings),
                           .disabledPasses = {options.disabled.begin(), options.disabled.end()},
                           .seed = options.seed,
                           .isAsPublished = options.isAsPublished},
                          registry());
    run::setSize(settings, params::parsePictureSize(options.size, "open"));
    return settings;
}

void checkTime(double seconds) {
    if (std::abs(seconds) <= 1e9) return;
    throw ConfigError(
        fmt::format("time: {} is not from -1000000000 to 1000000000 seconds.", seconds));
}

// A folder for pictures that were not asked for.
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

}  // namespace

std::vector<params::Assignment> assignmentsOf(const std::map<std::string, std::string>& settings) {
    std::vector<params::Assignment> assignments;
    for (const auto& [name, value] : settings)
        assignments.push_back({name, value, "set"});
    return assignments;
}

json timesOf(const report::RunRecord& record) {
    std::vector<double> frames;
    for (const gl::FrameTime& frame : record.frames)
        frames.push_back(frame.frameMs);
    json passes = json::array();
    for (const report::PassTimes& pass : report::timesByPass(record)) {
        passes.push_back({{"name", pass.name},
                          {"gpu_ms", jsonOf(report::summarize(pass.gpuMilliseconds))},
                          {"cpu_ms", jsonOf(report::summarize(pass.cpuMilliseconds))}});
    }
    return {{"frames", record.frames.size()},
            {"frame_ms", jsonOf(report::summarize(std::move(frames)))},
            {"passes", std::move(passes)}};
}

Session::Device::Device(scene::Scene loaded, const SessionOptions& options)
    : scene(std::move(loaded)) {
    RenderSettings settings = makeSettings(options);
    const auto begin = std::chrono::steady_clock::now();
    if (options.time) {
        checkTime(*options.time);
        scene::setTime(scene, *options.time);
    }
    context = gl::Context::createHeadless(options.debugs, options.device);
    session.emplace(
        *context, registry(), scene, std::move(settings),
        run::SessionOptions{.isPrecise = options.isPrecise, .framesKept = kFrameHistory});
    session->prepare();
    session->noteStartup(begin);
}

void Session::Device::change(RenderSettings settings) {
    session->change(std::move(settings));
    isStale = true;
}

void Session::Device::adopt(RenderSettings settings) {
    session->adopt(std::move(settings));
    isStale = true;
}

void Session::Device::noteEdit() {
    session->noteSceneChange();
    session->forgetTimes();
    isStale = true;
}

void Session::Device::requireFrame(const ShouldContinue& shouldContinue) {
    if (!hasStepped) throw ConfigError("No frame has been rendered yet; step() renders one.");
    if (isStale)
        throw ConfigError("Something was changed after the last frame; step() renders it.");
    if (session->hasFrame()) return;
    if (!session->renderAgain([&](std::size_t) { return shouldContinue(); })) throw Stopped();
}

graph::ResourceRef Session::Device::requireTexture(const std::string& name,
                                                   const ShouldContinue& shouldContinue) {
    requireFrame(shouldContinue);
    const Renderer& renderer = session->renderer();
    const graph::Graph& graph = renderer.graph();
    const graph::ResourceRef handle = graph.find(name);
    if (!handle.valid()) {
        throw ConfigError(fmt::format("There is no resource '{}'{}; resources() lists them all.",
                                      name, didYouMean(name, graph.resourceNames())));
    }
    if (!run::isTexture(renderer, name)) {
        throw ConfigError(fmt::format(
            "'{}' is a buffer, and only textures can be read (resources() says which those are).",
            name));
    }
    const FrameOutputs& outputs = renderer.outputs();
    for (const graph::ResourceRef& always : std::initializer_list<graph::ResourceRef>{
             outputs.picture.radiance, outputs.picture.display, outputs.caustic.irradiance,
             outputs.caustic.radiance, outputs.inScattered.radiance}) {
        if (handle == always) return handle;
    }
    if (read.insert(name).second) {
        session->keep(read);
        requireFrame(shouldContinue);
    }
    return renderer.graph().find(name);
}

json Session::Device::step(const StepRequest& request, const ShouldContinue& shouldContinue) {
    run::FrameSeries series{request.frames, request.warmup, request.time, request.timeStep};
    checkSeries(series, {"n", "warmup", "time_step"});
    if (!series.firstSeconds)
        series.firstSeconds = scene.timeSeconds + (hasStepped ? request.timeStep : 0.0);
    checkTime(*series.firstSeconds);
    checkTime(series.secondsOf(request.frames - 1, scene.timeSeconds));
    const run::RenderedSeries rendered =
        session->render(series, {[&](std::size_t) { return shouldContinue(); },
                                 [&](int) {
                                     hasStepped = true;
                                     isStale = false;
                                 }});
    if (!rendered.isWhole) throw Stopped();
    report::RunRecord these = session->record();
    these.frames = rendered.times;
    return timesOf(these);
}

run::RunReference Session::Device::referenceFor(const Judgement& judgement,
                                                const ShouldContinue& shouldContinue) {
    return session->referenceFor({}, judgement.reference, judgement.photons,
                                 {shouldContinue, [](double, const std::string&) {}});
}

json Session::Device::report(const Judgement& judgement, const ShouldContinue& shouldContinue) {
    requireFrame(shouldContinue);
    const run::RunReference reference = referenceFor(judgement, shouldContinue);
    std::optional<report::RunRecord> record = session->measure(
        reference, session->keptTextures(), [&](std::size_t) { return shouldContinue(); });
    if (!record) throw Stopped();
    Renderer& renderer = session->renderer();
    if (reference.purpose() == Purpose::audit) {
        const TemporaryFolder pictures;
        static_cast<void>(reference.judge(renderer, pictures.path, *record));
        static_cast<void>(reference.judgeView(renderer, pictures.path, *record));
    }
    return report::makeReport(*record, renderer, context->info());
}

std::vector<fs::path> Session::Device::save(const fs::path& folder,
                                            const std::vector<std::string>& resources,
                                            const Judgement& judgement,
                                            const ShouldContinue& shouldContinue) {
    for (const std::string& name : resources)
        static_cast<void>(requireTexture(name, shouldContinue));
    requireFrame(shouldContinue);
    run::requireWritable(folder, "folder");
    const run::RunReference reference = referenceFor(judgement, shouldContinue);
    return session->finish(reference, folder, resources).files;
}

}  // namespace kaustik::python
