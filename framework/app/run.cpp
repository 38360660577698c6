// SPDX-License-Identifier: MIT
// kaustik run: renders frames, times them, and writes pictures and the report.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <optional>

#include "framework/app/certified_run.h"
#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/number_text.h"
#include "framework/gl/capture.h"
#include "framework/image/tev_client.h"
#include "framework/report/limits.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"
#include "framework/run/session.h"
#include "framework/run/tile_run.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::app {
namespace {
namespace fs = std::filesystem;

run::FrameSeries seriesOf(const RunOptions& options) {
    const run::FrameSeries series{options.frames, options.warmup, {}, options.timeStepSeconds};
    run::checkSeries(series, {"--frames", "--warmup", "--time-step"});
    if (options.referencePhotons < 1) {
        throw ConfigError(
            fmt::format("--reference-photons: {} is not above 0.", options.referencePhotons));
    }
    return series;
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
    checkTileOptions(options);
    if (!options.tile.empty()) return traceTileCommand(options, registry);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    run::FrameSeries series = seriesOf(options);
    std::optional<report::DeviceModel> model;
    if (!options.deviceModel.empty())
        model = report::parseDeviceModel(options.deviceModel, "--device-model");
    scene::Scene scene =
        loadRequestedScene(options.scene.scene, options.scene.time, options.scene.scenePlace);
    series.firstSeconds = scene.timeSeconds;
    // Pictures, ledger and reference are the last frame's.
    const double lastSeconds = series.secondsOf(series.frames - 1, scene.timeSeconds);
    if (lastSeconds != scene.timeSeconds) scene::setTime(scene, lastSeconds);
    RenderSettings settings = makeSettings(options.scene, registry, options.seed);
    settings.hasLedger = options.hasLedger;
    settings.asOnGpu = model.has_value();
    const fs::path folder =
        options.out.empty()
            ? fs::path("results/runs") /
                  fmt::format("{}-{}{}", scene.name, settings.technique.name,
                              settings.technique.isAsPublished ? "-as-published" : "")
            : fs::path(options.out);

    if (options.captures) gl::requireRenderDoc();
    std::optional<TevClient> viewer;
    if (options.viewer) viewer.emplace(*options.viewer);

    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(options.scene.glDebug);
    if (!options.tiles.empty())
        settings.tiles = run::loadTiles(options.tiles, run::tileSubject(*context, scene, settings));
    run::Session session(*context, registry, scene, std::move(settings),
                         {.isPrecise = options.precise});
    session.check(options.saved);
    session.prepare();
    run::requireWritable(folder, "--out");
    run::catchInterrupts();
    session.noteStartup(begin);

    // Before the frames, since it may be refused.
    const bool isCertified = options.reference == kCertifiedReference;
    std::optional<certify::Certificate> certificate;
    if (isCertified) {
        if (series.frames > 1 && series.timeStepSeconds != 0.0) {
            throw ConfigError(
                "A certificate is of one time: --reference certified takes no --time-step.");
        }
        const RenderSettings& asked = session.renderer().settings();
        certificate = certificateFor(session.renderer().scene(), asked.width, asked.height);
    }
    run::RunReference reference =
        session.referenceFor(series, isCertified ? "none" : options.reference,
                             static_cast<std::uint64_t>(options.referencePhotons));
    std::vector<fs::path> captures;
    std::vector<std::string> warnings;
    try {
        {
            run::Progress progress("frame", series.warmup + series.frames);
            const auto onFrame = [&](int done) {
                progress.update(done);
                run::throwIfInterrupted();
            };
            // A capture and a model render the picture once more, and a frame for measurement has a
            // ledger.
            const bool isOneEnough = !options.captures && !model && options.hasLedger;
            session.render(series, {{}, onFrame}, &reference,
                           isOneEnough ? &options.saved : nullptr);
        }
        if (options.captures) {
            captures.push_back(gl::captureFrame(folder, [&] { session.renderAgain(); }));
            warnings.emplace_back("RenderDoc was there, which takes time in every frame.");
        }
        if (model) session.modelCost(*model);
    } catch (const DeviceError& error) {
        const bool lacksCost = model && !session.record().cost;
        throw session.keepUnfinished(
            error, folder, reference,
            lacksCost ? std::vector<std::string>{"cost"} : std::vector<std::string>());
    }
    const run::FinishedRun finished = session.finish(reference, folder, options.saved, warnings);
    const report::RunRecord& record = finished.record;
    const Renderer& renderer = session.renderer();

    if (viewer) showPictures(*viewer, finished.files, scene.name);

    fmt::print("{} with {}, {}x{}, on {}{}\n", scene.name, renderer.settings().technique.name,
               renderer.settings().width, renderer.settings().height, context->info().renderer,
               context->info().debugs ? ", debugged" : "");
    fmt::print("{}", report::makeTable(record));
    for (const ReachedLimit& limit : report::reachedLimits(record, renderer))
        fmt::print("limit   {} = {}: {}\n", limit.parameter, numberText(limit.value),
                   limit.sentence);
    for (const std::string& warning : record.warnings)
        fmt::print("warning: {}\n", warning);
    for (const std::vector<fs::path>& files : {finished.files, captures}) {
        for (const fs::path& file : files)
            fmt::print("wrote {}\n", file.string());
    }
    if (certificate) judgeByCertificate(*certificate, folder);
    // Last, so that everything is there for whoever looks for the cause.
    if (!record.violations.empty())
        throw ConservationError(fmt::format("{}", fmt::join(record.violations, " ")));
}

}  // namespace kaustik::app
