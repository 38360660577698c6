// SPDX-License-Identifier: MIT
#include "framework/run/run_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/report/map_account.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"

namespace kaustik::run {
namespace fs = std::filesystem;

report::RunRecord startRecord(const Renderer& renderer, gl::TimerMode timer) {
    report::RunRecord record;
    record.timer = timer;
    record.graphBuildMilliseconds = renderer.buildMilliseconds();
    record.passes = renderer.compiled().records;
    record.textureBytes = renderer.compiled().textureBytes;
    record.bufferBytes = renderer.compiled().bufferBytes;
    record.peakBytes = renderer.compiled().peakBytes;
    for (const graph::Step& step : renderer.compiled().steps) {
        record.stepNames.push_back(step.name);
        record.stepBytes.emplace_back(step.liveTextureBytes, step.liveBufferBytes);
    }
    return record;
}

bool measureRun(Renderer& renderer, const RunReference& reference, report::RunRecord& record,
                const std::vector<std::string>& saved,
                const std::function<bool(std::size_t)>& goesOn) {
    renderer.build(reference.purpose(), saved);
    gl::PassTimer untimed(gl::TimerMode::finish);
    if (!renderer.renderFrame(untimed, goesOn)) return false;
    record.ledger = renderer.ledger();
    record.layers = renderer.layerStatistics();
    record.layersAllowed = renderer.outputs().layers.layers;
    record.nodeLimits = renderer.reachedLimits();
    record.map = report::mapAccount(renderer);
    record.cells = report::cellAccount(renderer);
    record.photonsEnd = renderer.outputs().hits.incoming.paths.end;
    const std::vector<std::string>& ofScene = renderer.scene().warnings;
    record.warnings.insert(record.warnings.end(), ofScene.begin(), ofScene.end());
    record.warnings.insert(record.warnings.end(), renderer.warnings().begin(),
                           renderer.warnings().end());
    if (!renderer.isRandom() && record.seed != report::RunRecord{}.seed) {
        record.warnings.push_back(fmt::format(
            "--seed {} has no effect: nothing in this frame is drawn at random.", record.seed));
    }
    if (record.timeStepSeconds != 0.0 && !renderer.needs().animated) {
        record.warnings.push_back(
            fmt::format("--time-step {:g} has no effect: nothing moves in this scene.",
                        record.timeStepSeconds));
    }
    for (const std::string& name : unusedSettings(renderer)) {
        record.warnings.push_back(
            fmt::format("{} was set, but no node of this run uses it.", name));
    }
    return true;
}

std::vector<fs::path> finishRun(Renderer& renderer, const RunReference& reference,
                                report::RunRecord& record, const fs::path& folder,
                                const std::vector<std::string>& saved,
                                const gl::DeviceInfo& device) {
    measureRun(renderer, reference, record, saved);
    throwIfInterrupted();
    // A report beside the pictures of another run would be worse than none.
    FilesTogether together(folder);
    try {
        const fs::path& work = together.workFolder();
        std::vector<fs::path> files = writePictures(work, renderer, saved);
        const std::vector<fs::path> judged = reference.judge(renderer, work, record);
        files.insert(files.end(), judged.begin(), judged.end());
        const std::vector<fs::path> seen = reference.judgeView(renderer, work, record);
        files.insert(files.end(), seen.begin(), seen.end());
        const auto write = [&](const char* name, const std::string& text) {
            files.push_back(work / name);
            writeFileWhole(files.back(), text);
        };
        write("trace.json", jsonText(report::makeChromeTrace(record)));
        write("samples.json", jsonText(report::makeSamples(record)));
        write("report.json", jsonText(report::makeReport(record, renderer, device), 2) + "\n");
        together.publish("report.json");
        for (fs::path& file : files)
            file = together.placeOf(file);
        return files;
    } catch (const IoError& error) {
        throw IoError(together.withPlaces(error.what()));
    }
}

}  // namespace kaustik::run
