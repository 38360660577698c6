// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cfloat>
#include <functional>

#include "framework/core/error.h"
#include "framework/core/shell_word.h"
#include "framework/gui/experiment_file.h"
#include "framework/gui/number_fields.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/recording_name.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {

void saveExperiment(Bench& bench) {
    try {
        ExperimentTerms terms;
        terms.isPrecise = bench.panels.isPrecise;
        if (hasSameView(*bench.reference, bench.document))
            terms.referencePhotons = bench.reference->photons;
        const std::vector<std::filesystem::path> files =
            writeExperiment(bench.document, bench.registry, recordFolder(bench.panels),
                            recordingName(bench.document.scene), terms);
        bench.notify(
            fmt::format("Wrote {}; `kaustik experiment run {}` does it again{}.",
                        files.front().string(), shellWord(files.front().string()),
                        terms.referencePhotons > 0 ? ", errors by its reference too" : ""));
    } catch (const std::exception& error) {
        bench.notifyUnwritten(error.what());
    }
}

namespace {

#ifdef KAUSTIK_HAS_EMBREE
constexpr bool kHasReference = true;
#else
constexpr bool kHasReference = false;
#endif

void drawReport(Bench& bench, const std::filesystem::path& folder,
                const std::function<void(const char*)>& explain) {
    PanelState& panels = bench.panels;
    if (button(bench, "Report of 8 frames", "record.report")) {
        RecordRequest request;
        request.folder = folder / recordingName(bench.document.scene);
        if (kHasReference && panels.judgesReports)
            request.referencePhotons = static_cast<std::uint64_t>(panels.referencePhotons);
        bench.renderer->record(request);
    }
    explain(
        "What 'kaustik run' writes: pictures, caustic, report.json and the Chrome trace, of "
        "variant A.");
    ImGui::SameLine();
    ImGui::BeginDisabled(!kHasReference);
    static_cast<void>(checkbox(bench, "with its error", panels.judgesReports, "record.judged"));
    ImGui::EndDisabled();
    tooltip(kHasReference
                ? fmt::format("What 'kaustik run --reference auto' writes, too: error and hits, "
                              "against a reference of {:.3g} million photons (panel Error), which "
                              "is computed first where there is none.",
                              panels.referencePhotons * 1e-6)
                : "This program was built without Embree and knows no reference.");
}

}  // namespace

void drawRecord(Bench& bench) {
    ImGui::TextUnformatted("Folder");
    ImGui::SetNextItemWidth(-FLT_MIN);
    inputText(bench, "##folder", "the folder that the program was started in",
              bench.panels.recordFolder, "record.folder");
    const std::filesystem::path folder = recordFolder(bench.panels);
    std::error_code ignored;
    tooltip(std::filesystem::absolute(folder, ignored).lexically_normal().string());
    RenderWorker::Recording recording = bench.renderer->recording();
    // Why one folder was refused is of no interest once there is another one.
    if (recording.hasFailed && recording.folder != folder / recording.folder.filename() &&
        !std::filesystem::exists(recording.folder, ignored))
        recording.message.clear();

    ImGui::Spacing();
    if (button(bench, "Screenshot of the window (F12)", "record.screenshot"))
        bench.wantsScreenshot = true;
    const std::string obstacle = runObstacle(bench.requested(), *bench.result);
    const auto explain = [&](const char* sentence) {
        tooltip(obstacle.empty() ? sentence : "What is set up cannot run: " + obstacle);
    };
    ImGui::BeginDisabled(!obstacle.empty());
    if (button(bench, "Save as experiment (Ctrl S)", "record.experiment"))
        bench.wantsExperiment = true;
    explain(
        "A .toml that 'kaustik experiment run' reproduces bit for bit on this device, with the "
        "camera, lights and waves as they are now. Where there is a reference of this view its "
        "runs "
        "are judged by it, so that their errors come back too.");
    ImGui::BeginDisabled(recording.isActive);
    drawReport(bench, folder, explain);
    ImGui::Spacing();
    ImGui::SetNextItemWidth(widthBeside("seconds between"));
    inputCount(bench, "pictures", bench.panels.sequenceFrames, 1, PanelState::kMaxSequenceFrames,
               "record.frames");
    constexpr const char* kStep = "seconds between";
    ImGui::SetNextItemWidth(widthBeside(kStep));
    ImGui::DragFloat(kStep, &bench.panels.sequenceStep, 0.001f, 0.0001f, 10.0f, "%.4g");
    // Before it is done with, each sign that was typed is a number.
    if (!ImGui::IsAnyItemActive())
        keepWithin(bench, kStep, bench.panels.sequenceStep, 0.0001f, 10.0f);
    bench.map.control("record.step", fmt::format("{}", bench.panels.sequenceStep));
    if (button(bench, "Image sequence", "record.sequence")) {
        RecordRequest request;
        request.what = RecordRequest::RecordingKind::sequence;
        request.folder = folder / recordingName(bench.document.scene);
        request.frames = bench.panels.sequenceFrames;
        request.secondsPerFrame = double(bench.panels.sequenceStep);
        bench.isPlaying = false;
        bench.renderer->record(request);
    }
    explain("0000.png and on, every picture whole, from the time at hand.");
    ImGui::EndDisabled();
    ImGui::EndDisabled();
    if (recording.isActive && button(bench, "Cancel", "record.cancel"))
        bench.renderer->cancelRecording();
    ImGui::PushTextWrapPos(0.0f);
    if (recording.hasFailed) {
        ImGui::TextColored(kProblemColor, "%s", recording.message.c_str());
    } else {
        ImGui::TextUnformatted(recording.message.c_str());
    }
    ImGui::PopTextWrapPos();
    bench.map.area("record.state", 0, 0, 0, 0,
                   fmt::format("{}: {}", recording.isActive ? "busy" : "idle", recording.message));
}

}  // namespace kaustik::gui
