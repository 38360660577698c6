// SPDX-License-Identifier: MIT
// What a session's frames leave behind: the record that reports are made of, and files.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/report/map_account.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"
#include "framework/run/session.h"

namespace kaustik::run {
namespace fs = std::filesystem;

report::RunRecord Session::measured() const {
    report::RunRecord record = record_;
    record.ledger = renderer_.ledger();
    record.layers = renderer_.layerStatistics();
    record.layersAllowed = renderer_.outputs().layers.layers;
    record.nodeLimits = renderer_.reachedLimits();
    return record;
}

std::optional<report::RunRecord> Session::measure(const RunReference& reference,
                                                  const std::vector<std::string>& saved,
                                                  const ShouldContinue& shouldContinue) {
    bringUpToDate();
    forgetBuild();
    renderer_.build(reference.purpose(), saved);
    if (!renderUntimed(shouldContinue)) return std::nullopt;
    // What judges the frame may render another one, and what is kept may not be in this one.
    hasFrame_ = reference.purpose() == Purpose::measurement && saved == keptTextures();
    report::RunRecord record = measured();
    record.map = report::mapAccount(renderer_);
    record.cells = report::cellAccount(renderer_);
    record.photonsEnd = renderer_.outputs().hits.incoming.paths.end;
    for (const auto* warnings : {&renderer_.scene().warnings, &renderer_.warnings()})
        record.warnings.insert(record.warnings.end(), warnings->begin(), warnings->end());
    if (!renderer_.isRandom() && record.seed != report::RunRecord{}.seed) {
        record.warnings.push_back(fmt::format(
            "--seed {} has no effect: nothing in this frame is drawn at random.", record.seed));
    }
    if (record.timeStepSeconds != 0.0 && !renderer_.needs().animated) {
        record.warnings.push_back(
            fmt::format("--time-step {:g} has no effect: nothing moves in this scene.",
                        record.timeStepSeconds));
    }
    return record;
}

FinishedRun Session::finish(const RunReference& reference, const fs::path& folder,
                            const std::vector<std::string>& saved,
                            const std::vector<std::string>& warnings) {
    FinishedRun finished{measure(reference, saved).value(), {}};
    report::RunRecord& record = finished.record;
    record.warnings.insert(record.warnings.begin(), warnings.begin(), warnings.end());
    throwIfInterrupted();
    // A report next to the pictures of another run would be worse than none.
    FilesTogether together(folder);
    try {
        const fs::path& work = together.workFolder();
        std::vector<fs::path>& files = finished.files;
        files = writePictures(work, renderer_, saved);
        const std::vector<fs::path> judged = reference.judge(renderer_, work, record);
        files.insert(files.end(), judged.begin(), judged.end());
        const std::vector<fs::path> seen = reference.judgeView(renderer_, work, record);
        files.insert(files.end(), seen.begin(), seen.end());
        const auto write = [&](const char* name, const std::string& text) {
            files.push_back(work / name);
            writeFileWhole(files.back(), text);
        };
        write("trace.json", jsonText(report::makeChromeTrace(record)));
        write("samples.json", jsonText(report::makeSamples(record)));
        write("report.json",
              jsonText(report::makeReport(record, renderer_, context_.info()), 2) + "\n");
        together.publish("report.json");
        for (fs::path& file : files)
            file = together.placeOf(file);
        return finished;
    } catch (const IoError& error) {
        throw IoError(together.withPlaces(error.what()));
    }
}

}  // namespace kaustik::run
