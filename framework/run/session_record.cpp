// SPDX-License-Identifier: MIT
// What a session's frames leave behind: the record that reports are made of, and files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/core/names.h"
#include "framework/report/loss_advice.h"
#include "framework/report/map_account.h"
#include "framework/report/violations.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"
#include "framework/run/session.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "framework/run/path_account.h"
#endif

namespace kaustik::run {
namespace fs = std::filesystem;
namespace {

// In the folder of a run.
constexpr const char* kUnfinishedFolder = "unfinished";

// What the report of a run that was to be judged lacks where it was not.
std::vector<std::string> judgement(const RunReference& reference) {
    if (reference.purpose() != Purpose::audit) return {};
    return {"judgement by the reference"};
}

// Total reflection that no light meets in truth: lost by a paper's approximation, or by a node that
// looks bodies up in a view.
void addReflectionWarnings(report::RunRecord& record, const Renderer& renderer) {
    using namespace transport;
    const EnergyLedger& ledger = record.ledger;
    const double emitted = ledger.watts[kAccountEmitted];
    if (!(emitted > 0.0)) return;
    const std::string node = "specular." + renderer.settings().params.choice(SpecularStage::name);
    const double published = ledger.watts[kAccountAsPublished] / emitted;
    if (published > 0.0) {
        record.warnings.push_back(fmt::format(
            "{}: {:.3g}% of the light is lost as published: estimates of the distance inside have "
            "it totally reflected, which it is in no ball ({}.distance=search loses none of it).",
            node, 100.0 * published, node));
    }
    // Of texels at a silhouette, where light grazes the ball: there it all but is totally
    // reflected. In a grid that is the same from eight sides eight photons are there alike,
    // whatever they carry.
    constexpr double kRounding = 1e-4;
    constexpr std::uint64_t kGrazing = 8;
    const double reflected = ledger.watts[kAccountInternalReflectionLimit] / emitted;
    const std::uint64_t photons = ledger.events[kAccountInternalReflectionLimit];
    if (record.photonsEnd && reflected > kRounding && photons > kGrazing &&
        scene::hasBallsAlone(renderer.scene())) {
        record.warnings.push_back(fmt::format(
            "{}: {:.3g}% of the light is booked as internal_reflection_limit, but no light that "
            "has entered a ball is totally reflected in it.",
            node, 100.0 * reflected));
    }
}

// Light below the horizon of the true triangle.
void addNormalWarning(report::RunRecord& record) {
    constexpr double kWorthSaying = 0.01;
    const double turned = record.ledger.watts[transport::kAccountTriangleNormal] /
                          std::max(record.ledger.watts[transport::kAccountEmitted], 1e-30);
    if (!(turned > kWorthSaying)) return;
    record.warnings.push_back(fmt::format(
        "{:.2g}% of the flux, counted at each surface that it meets, met a normal, of a mesh or a "
        "normal map, that would send it to the wrong side of its triangle; there the triangle's "
        "own "
        "normal bends it.",
        100.0 * turned));
}

}  // namespace

report::RunRecord Session::measured() const {
    report::RunRecord record = record_;
    record.ledger = renderer_.ledger();
    if (record.ledger.events[transport::kAccountEmittable] > 0)
        record.ledger.judgeEmission(record.ledger.watts[transport::kAccountEmittable]);
    record.primitives = report::primitiveFlux(renderer_);
    record.eyeRays = renderer_.eyeRays();
    record.layers = renderer_.layerStatistics();
    record.layersAllowed = renderer_.outputs().layers.layers;
    record.nodeLimits = renderer_.reachedLimits();
    record.violations = report::violations(record.ledger, renderer_);
    record.map = report::mapAccount(renderer_);
    record.warnings = renderer_.foundWarnings();
    const std::string filter = renderer_.settings().params.choice(FilterStage::name);
    if (const std::optional<std::string> warning = report::mapWarning(record.map, filter))
        record.warnings.push_back(*warning);
    for (const std::string& advice : report::lossAdvice(record.ledger, renderer_))
        record.warnings.push_back(advice);
    return record;
}

std::optional<report::RunRecord> Session::measure(const RunReference& reference,
                                                  const std::vector<std::string>& saved,
                                                  const ShouldContinue& shouldContinue) {
    if (std::exchange(measuredFrame_, {}) != MeasuredFrame{reference.purpose(), saved}) {
        bringUpToDate();
        forgetBuild();
        renderer_.build(reference.purpose(), saved);
        if (!renderUntimed(shouldContinue)) return std::nullopt;
    }
    // What judges the frame may render another one, and what is kept may not be in this one.
    hasFrame_ = reference.purpose() == Purpose::measurement && saved == keptTextures();
    report::RunRecord record = measured();
    context_.setScope("while the ledger was read");
    context_.check();
    record.cells = report::cellAccount(renderer_);
    record.photonsEnd = renderer_.outputs().hits.incoming.paths.end;
    const std::uint64_t stopped = record.ledger.events[transport::kAccountBounceLimit];
    if (record.photonsEnd && stopped > 0) {
        const transport::uint bounce = transport::kAccountBounceLimit;
        record.warnings.push_back(fmt::format(
            "{} photons, {:.2g}% of the flux, came to a further specular surface, from where "
            "specular={} sends nothing on ('bounce_limit' in the ledger); specular=split does, "
            "with a tracer that finds specular surfaces.",
            stopped,
            100.0 * record.ledger.watts[bounce] / record.ledger.watts[transport::kAccountEmitted],
            renderer_.settings().params.choice(SpecularStage::name)));
    }
    for (const auto* warnings : {&renderer_.warnings(), &renderer_.scene().warnings})
        record.warnings.insert(record.warnings.begin(), warnings->begin(), warnings->end());
    addReflectionWarnings(record, renderer_);
    addNormalWarning(record);
#ifdef KAUSTIK_HAS_EMBREE
    if (const std::optional<reference::PathCensus> census = findCensus(renderer_.scene())) {
        const ModelledPaths& paths = renderer_.outputs().hits.incoming.paths;
        record.unformed = unformedJson(*census, paths);
        const std::string sentence =
            unformedSentence(*census, paths, renderer_.settings().technique.name);
        if (!sentence.empty()) record.warnings.push_back(sentence);
    }
#endif
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
    Done done{record_, false, {}};
    std::optional<FilesTogether> together;
    const auto requireDevice = [&](const char* scope) {
        context_.setScope(scope);
        context_.check();
    };
    try {
        FinishedRun finished{measure(reference, saved).value(), {}};
        report::RunRecord& record = finished.record;
        record.warnings.insert(record.warnings.begin(), warnings.begin(), warnings.end());
        done.record = record;
        done.hasLedger = true;
        throwIfInterrupted();
        // A report next to the pictures of another run would be worse than none.
        together.emplace(folder);
        const fs::path& work = together->workFolder();
        std::vector<fs::path>& files = finished.files;
        files = writePictures(work, renderer_, saved);
        requireDevice("while the pictures were read");
        done.pictures = files;
        const std::vector<fs::path> judged = reference.judge(renderer_, work, record);
        files.insert(files.end(), judged.begin(), judged.end());
        const std::vector<fs::path> seen = reference.judgeView(renderer_, work, record);
        files.insert(files.end(), seen.begin(), seen.end());
        if (reference.purpose() == Purpose::audit) requireDevice("while the run was judged");
        const auto write = [&](const char* name, const std::string& text) {
            files.push_back(work / name);
            writeFileWhole(files.back(), text);
        };
        write("trace.json", jsonText(report::makeChromeTrace(record)));
        write("samples.json", jsonText(report::makeSamples(record)));
        write("report.json",
              jsonText(report::makeReport(record, renderer_, context_.info()), 2) + "\n");
        together->publish("report.json");
        for (fs::path& file : files)
            file = together->placeOf(file);
        std::error_code ignored;
        fs::remove_all(folder / kUnfinishedFolder, ignored);
        return finished;
    } catch (const IoError& error) {
        throw IoError(together ? together->withPlaces(error.what()) : error.what());
    } catch (const DeviceError& error) {
        throw keep(std::move(done), error, folder, judgement(reference));
    } catch (const std::exception&) {
        // What is read from a lost device may be anything, and bring anything about.
        try {
            requireDevice("while what it had rendered was read");
        } catch (const DeviceError& error) {
            throw keep(std::move(done), error, folder, judgement(reference));
        }
        throw;
    }
}

DeviceError Session::keepUnfinished(const DeviceError& error, const fs::path& folder,
                                    const RunReference& reference,
                                    const std::vector<std::string>& alsoMissing) const {
    std::vector<std::string> missing = judgement(reference);
    missing.insert(missing.end(), alsoMissing.begin(), alsoMissing.end());
    return keep({record_, false, {}}, error, folder, std::move(missing));
}

DeviceError Session::keep(Done done, const DeviceError& error, const fs::path& folder,
                          std::vector<std::string> missing) const {
    if (error.exitCode() != kExitDeviceLost) return error;
    std::string why = error.what();
    const auto andThen = [&](const std::string& next) {
        if (why.ends_with('.')) why.pop_back();
        return DeviceError(fmt::format("{}; {}.", why, next));
    };
    report::RunRecord& record = done.record;
    if (record.frames.empty()) return andThen("no frame was done by then, and nothing is kept");
    if (done.pictures.empty()) missing.insert(missing.begin(), "pictures");
    if (!done.hasLedger) missing.insert(missing.begin(), "ledger");
    record.endedEarly = report::EndedEarly{why, missing, done.hasLedger};
    const fs::path place = folder / kUnfinishedFolder;
    try {
        std::error_code ignored;
        fs::remove_all(place, ignored);  // of a run before
        FilesTogether together(place);
        const fs::path& work = together.workFolder();
        for (const fs::path& picture : done.pictures)
            fs::rename(picture, work / picture.filename());
        writeFileWhole(work / "trace.json", jsonText(report::makeChromeTrace(record)));
        writeFileWhole(work / "samples.json", jsonText(report::makeSamples(record)));
        writeFileWhole(work / "report.json",
                       jsonText(report::makeReport(record, renderer_, context_.info()), 2) + "\n");
        together.publish("report.json");
    } catch (const std::exception& problem) {
        return andThen(fmt::format("what was done could not be kept: {}", problem.what()));
    }
    return andThen(fmt::format("what was done, {} timed frame{} without {}, is in {}",
                               record.frames.size(), record.frames.size() == 1 ? "" : "s",
                               joinNames(missing), place.string()));
}

}  // namespace kaustik::run
