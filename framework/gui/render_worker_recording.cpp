// SPDX-License-Identifier: MIT
// The render worker's recordings: the report of a run, or the pictures of a sequence.
#include <fmt/format.h>

#include <utility>

#include "framework/core/error.h"
#include "framework/gui/render_worker_device.h"
#include "framework/run/output.h"
#include "framework/run/session.h"

namespace kaustik::gui {
namespace fs = std::filesystem;

void RenderWorker::writeRecording(Device& device, const RecordRequest& request) {
    try {
        run::requireWritable(request.folder, "Recording");
        if (request.what == RecordRequest::RecordingKind::report) {
            writeReport(device, request);
        } else {
            writeSequence(device, request);
        }
    } catch (const DeviceError& error) {
        setRecording({false, error.what(), true});
        throw;
    } catch (const Error& error) {
        // A reference that is ended in the middle is an error for others.
        setRecording({false, cancelRecording_ ? "The report was cancelled." : error.what(), true});
    }
    // The picture that is shown comes back by a frame of its own.
    device.framesDone = 0;
    device.toRender = 0;
    device.hasExtras = false;
    if (device.renderers[0]) device.renderers[0]->noteSceneChange();
}

void RenderWorker::writeReport(Device& device, const RecordRequest& request) {
    const Document& document = device.order.document;
    run::Session session(*device.context, registry_, *device.scene,
                         settingsOf(document.variant, document.size, registry_),
                         {.isPrecise = device.order.isPrecise});
    session.prepare();
    const run::Watch watch{
        [this] { return !stop_ && !cancelRecording_; },
        [this](double share, const std::string& reached) {
            setRecording(
                {true, fmt::format("reference, {:.0f} %: {}", 100.0 * share, reached), false});
        }};
    if (request.referencePhotons > 0) setRecording({true, "looking for a reference", false});
    const run::FrameSeries series{.frames = request.frames, .warmup = 1};  // the first one compiles
    run::RunReference reference = session.referenceFor(
        series, request.referencePhotons > 0 ? "auto" : "none", request.referencePhotons, watch);
    const auto shouldContinue = [this](std::size_t) { return !stop_ && !cancelRecording_; };
    const auto tell = [&](int frame) {
        if (frame > request.frames) return;
        setRecording({true, fmt::format("frame {} of {}", frame, request.frames), false});
    };
    tell(0);
    if (!session.render(series, {shouldContinue, tell}, &reference).isWhole)
        return setRecording({false, "The report was cancelled.", true});
    setRecording(
        {true, reference.purpose() == Purpose::audit ? "measuring and writing" : "writing", false});
    const run::FinishedRun finished = session.finish(reference, request.folder, {});
    setRecording(
        {false,
         fmt::format("Wrote {} files into {}.", finished.files.size(), request.folder.string()),
         false});
}

void RenderWorker::writeSequence(Device& device, const RecordRequest& request) {
    const Document& document = device.order.document;
    scene::Scene scene = *device.scene;
    run::Session session(*device.context, registry_, scene,
                         settingsOf(document.variant, document.size, registry_),
                         {.isPrecise = true});
    const auto shouldContinue = [this](std::size_t) { return !stop_ && !cancelRecording_; };
    int written = 0;
    const auto tell = [&] {
        if (written == request.frames) return;
        setRecording({true, fmt::format("picture {} of {}", written + 1, request.frames), false});
    };
    const auto write = [&](int) {
        const Renderer& renderer = session.renderer();
        writeImage(request.folder / fmt::format("{:04}{}", written++, displayImageExtension()),
                   run::readTexture(renderer.texture(renderer.outputs().picture.display), 0, 3));
        tell();
    };
    tell();
    const run::FrameSeries series{.frames = request.frames,
                                  .timeStepSeconds = request.secondsPerFrame};
    if (!session.render(series, {shouldContinue, write}).isWhole) {
        const std::string message =
            written == 0 ? "Cancelled before the first picture."
                         : fmt::format("Cancelled after {} of {} pictures, which are in {}.",
                                       written, request.frames, request.folder.string());
        return setRecording({false, message, true});
    }
    setRecording(
        {false, fmt::format("Wrote {} pictures into {}.", request.frames, request.folder.string()),
         false});
}

}  // namespace kaustik::gui
