// SPDX-License-Identifier: MIT
#include "framework/app/run_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/app/output.h"
#include "framework/app/progress.h"
#include "framework/core/files.h"

namespace kaustik::app {
namespace fs = std::filesystem;

report::RunRecord startRecord(const Renderer& renderer, gl::TimerMode timer) {
    report::RunRecord record;
    record.timer = timer;
    record.graphBuildMilliseconds = renderer.buildMilliseconds();
    record.passes = renderer.compiled().records;
    record.textureBytes = renderer.compiled().textureBytes;
    record.bufferBytes = renderer.compiled().bufferBytes;
    record.peakBytes = renderer.compiled().peakBytes;
    for (const graph::Step& step : renderer.compiled().steps)
        record.stepNames.push_back(step.name);
    return record;
}

std::vector<fs::path> finishRun(Renderer& renderer, const Truth& truth, report::RunRecord& record,
                                const fs::path& folder, const std::vector<std::string>& saved,
                                const gl::DeviceInfo& device) {
    renderer.build(truth.purpose(), saved);
    gl::PassTimer untimed(gl::TimerMode::finish);
    renderer.renderFrame(untimed);
    record.ledger = renderer.ledger();
    record.layers = renderer.layerStatistics();
    record.layersAllowed = renderer.outputs().layers.layers;
    record.nodeLimits = renderer.reachedLimits();
    record.warnings = renderer.scene().warnings;
    record.warnings.insert(record.warnings.end(), renderer.warnings().begin(),
                           renderer.warnings().end());
    for (const std::string& name : unusedSettings(renderer)) {
        record.warnings.push_back(
            fmt::format("{} was set, but no node of this run uses it.", name));
    }

    throwIfInterrupted();
    std::vector<fs::path> files = writePictures(folder, renderer, saved);
    const std::vector<fs::path> judged = truth.judge(renderer, folder, record);
    files.insert(files.end(), judged.begin(), judged.end());
    const std::vector<fs::path> seen = truth.judgeView(renderer, folder, record);
    files.insert(files.end(), seen.begin(), seen.end());
    const auto write = [&](const char* name, const std::string& text) {
        writeFileWhole(folder / name, text);
        files.push_back(folder / name);
    };
    write("trace.json", report::makeChromeTrace(record).dump());
    write("samples.json", report::makeSamples(record).dump());
    write("report.json", report::makeReport(record, renderer, device).dump(2) + "\n");
    return files;
}

}  // namespace kaustik::app
