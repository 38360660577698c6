// SPDX-License-Identifier: MIT
// The render worker's recordings: the report of a run, or the pictures of a sequence.
#include <fmt/format.h>

#include <utility>

#include "framework/core/error.h"
#include "framework/gui/render_worker_device.h"
#include "framework/run/output.h"
#include "framework/run/run_record.h"
#include "framework/run/run_reference.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::gui {
namespace fs = std::filesystem;

void RenderWorker::writeRecording(Device& device, const RecordRequest& request) {
    try {
        run::requireWritable(request.folder, "Recording");
        if (request.what == RecordRequest::What::report) {
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
    const gl::TimerMode mode =
        device.order.isPrecise ? gl::TimerMode::finish : gl::TimerMode::timestamps;
    Renderer renderer(*device.context, registry_, *device.scene,
                      settingsOf(document.variant, document.size, registry_));
    renderer.build(Purpose::picture);
    const run::Watch watch{
        [this] { return !stop_ && !cancelRecording_; },
        [this](double share, const std::string& reached) {
            setRecording(
                {true, fmt::format("reference, {:.0f} %: {}", 100.0 * share, reached), false});
        }};
    if (request.referencePhotons > 0) setRecording({true, "looking for a reference", false});
    const run::RunReference reference(request.referencePhotons > 0 ? "auto" : "none",
                                      request.referencePhotons, renderer, watch);
    report::RunRecord record = run::startRecord(renderer, mode);
    record.warmup = 1;
    gl::PassTimer timer(mode);
    for (int frame = 0; frame <= request.frames; ++frame) {
        setRecording({true, fmt::format("frame {} of {}", frame, request.frames), false});
        const bool isWhole =
            renderer.renderFrame(timer, [&](std::size_t) { return !stop_ && !cancelRecording_; });
        if (!isWhole) return setRecording({false, "The report was cancelled.", true});
        for (gl::FrameTime& time : timer.takeFinished(true))
            record.frames.push_back(std::move(time));
    }
    record.frames.erase(record.frames.begin());  // the first one compiles
    setRecording(
        {true, reference.purpose() == Purpose::audit ? "measuring and writing" : "writing", false});
    const std::vector<fs::path> files =
        run::finishRun(renderer, reference, record, request.folder, {}, device.context->info());
    setRecording({false,
                  fmt::format("Wrote {} files into {}.", files.size(), request.folder.string()),
                  false});
}

void RenderWorker::writeSequence(Device& device, const RecordRequest& request) {
    const Document& document = device.order.document;
    scene::Scene scene = *device.scene;
    const double begin = scene.timeSeconds;
    Renderer renderer(*device.context, registry_, scene,
                      settingsOf(document.variant, document.size, registry_));
    gl::PassTimer timer(gl::TimerMode::finish);
    for (int frame = 0; frame < request.frames; ++frame) {
        setRecording({true, fmt::format("picture {} of {}", frame + 1, request.frames), false});
        setTime(scene, begin + frame * request.secondsPerFrame);
        renderer.update(renderer.settings());
        renderer.build(Purpose::picture);
        const bool isWhole =
            renderer.renderFrame(timer, [&](std::size_t) { return !stop_ && !cancelRecording_; });
        if (!isWhole) {
            return setRecording({false,
                                 fmt::format("Cancelled after {} of {} pictures, which are in {}.",
                                             frame, request.frames, request.folder.string()),
                                 true});
        }
        static_cast<void>(timer.takeFinished(true));
        writeImage(request.folder / fmt::format("{:04}{}", frame, displayImageExtension()),
                   run::readTexture(renderer.texture(renderer.outputs().picture.display), 0, 3));
    }
    setRecording(
        {false, fmt::format("Wrote {} pictures into {}.", request.frames, request.folder.string()),
         false});
}

}  // namespace kaustik::gui
