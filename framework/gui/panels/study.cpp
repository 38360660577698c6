// SPDX-License-Identifier: MIT
// A study from the settings at hand: what is varied (study_axes.h), how many runs that are and what
// they will take, and their errors against their times as they come.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <filesystem>
#include <map>
#include <optional>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/core/shell_word.h"
#include "framework/gui/number_fields.h"
#include "framework/gui/panels/error_time_plot.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/study_axes.h"
#include "framework/gui/recording_name.h"
#include "framework/gui/showing.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

#ifdef KAUSTIK_HAS_EMBREE
constexpr bool kHasReference = true;
#else
constexpr bool kHasReference = false;
#endif

// What is set up in the panel.
struct Intended {
    Study study;
    ExperimentTerms terms;
    std::size_t runs = 0;
    std::string obstacle;           // why it cannot be run
    std::vector<std::string> idle;  // what is varied without an effect
};

Intended intended(const Bench& bench, const std::vector<TypedAxis>& typed) {
    Intended all;
    all.study.document = bench.document;
    all.study.document.variant = bench.variantOf(bench.editedIndex());
    all.study.document.other.reset();
    for (const TypedAxis& axis : typed) {
        all.study.axes.push_back(axis.axis);
        if (!axis.hasEffect) all.idle.push_back(axis.axis.key);
        if (!axis.problem.empty() && all.obstacle.empty())
            all.obstacle = fmt::format("The values of {} are not right yet.", axis.axis.key);
    }
    all.runs = typed.empty() ? 0 : runCount(all.study.axes);
    if (typed.empty()) all.obstacle = "Choose what is to be varied.";
    if (all.obstacle.empty() && all.runs > kMaxStudyRuns) {
        all.obstacle = fmt::format(
            "More than {} runs are for 'kaustik experiment' and its shards; take fewer values.",
            kMaxStudyRuns);
    }
    all.terms.frames = bench.panels.studyFrames;
    all.terms.isPrecise = bench.panels.isPrecise;
    if (kHasReference && bench.panels.judgesStudies) {
        const bool isHere =
            bench.reference->photons > 0 && hasSameView(*bench.reference, all.study.document);
        all.terms.referencePhotons =
            isHere ? bench.reference->photons
                   : static_cast<std::uint64_t>(bench.panels.referencePhotons);
    }
    return all;
}

// How many runs, how long, and judged by what.
void drawPlan(Bench& bench, const Intended& all) {
    std::string text;
    if (!all.obstacle.empty()) {
        text = all.obstacle;
    } else {
        text = fmt::format("{} run{}", all.runs, all.runs == 1 ? "" : "s");
        const KnownTimes known{bench.startSeconds, settledMedianOf(bench.editedResult().frameMs),
                               all.terms.isPrecise};
        if (known.frameMs > 0.0) {
            text += fmt::format(
                ", about {}",
                durationText(expectedSeconds(all.study, all.terms.frames, known, bench.points)));
        }
        text += ".";
        if (!all.idle.empty()) {
            text += fmt::format(" Counted too is what has no effect as it is: {}.",
                                joinNames(all.idle));
        }
        const bool isThere =
            bench.reference->photons > 0 && bench.reference->photons == all.terms.referencePhotons;
        if (all.terms.referencePhotons > 0) {
            text += fmt::format(" Errors by {} of {:.3g} million photons{}",
                                isThere ? "the reference" : "a reference",
                                static_cast<double>(all.terms.referencePhotons) * 1e-6,
                                isThere ? "." : ", which is computed first.");
        }
    }
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    bench.map.control("study.plan", text);
    tooltip(
        "By what this session knows: the time from its start to the first whole picture for each "
        "run, and for each frame what these settings took here, or else what is on the screen "
        "takes. A run is a program of its own, one after the other; the window takes its part of "
        "the machine while it is drawn.");
}

void drawTerms(Bench& bench) {
    PanelState& panels = bench.panels;
    ImGui::SetNextItemWidth(static_cast<float>(bench.px(90.0)));
    inputCount(bench, "frames each", panels.studyFrames, 1, 10000, "study.frames");
    ImGui::BeginDisabled(!kHasReference);
    static_cast<void>(checkbox(bench, "with errors", panels.judgesStudies, "study.judged"));
    ImGui::EndDisabled();
    tooltip(
        kHasReference
            ? "Each run is judged by the reference of this view, which the experiment's file asks "
              "for; where there is none it is computed first (panel Error has how many photons)."
            : "This program was built without Embree and knows no reference.");
}

void drawButtons(Bench& bench, const Intended& all) {
    const std::string unable = runObstacle(bench.requested(), *bench.result);
    const std::string obstacle = all.obstacle.empty() ? unable : all.obstacle;
    const bool isRunning = bench.study->isRunning;
    const std::string name = recordingName(bench.document.scene) + "-study";
    ImGui::BeginDisabled(!obstacle.empty() || isRunning);
    if (button(bench, "Run", "study.run")) {
        bench.isPlaying = false;
        bench.studies->start(all.study, all.terms, bench.registry, recordFolder(bench.panels),
                             name);
    }
    ImGui::EndDisabled();
    tooltip(obstacle.empty()
                ? fmt::format("Writes it into {} and runs it: 'kaustik experiment run'.",
                              recordFolder(bench.panels).string())
                : obstacle);
    ImGui::SameLine();
    ImGui::BeginDisabled(!obstacle.empty());
    if (button(bench, "Save", "study.save")) {
        try {
            const std::string file =
                writeStudy(all.study, bench.registry, recordFolder(bench.panels), name, all.terms)
                    .front()
                    .string();
            bench.notify(fmt::format("Wrote {}; `kaustik experiment run {}` does it.", file,
                                     shellWord(file)));
        } catch (const std::exception& error) {
            bench.notifyUnwritten(error.what());
        }
    }
    ImGui::EndDisabled();
    tooltip(obstacle.empty() ? "Just its .toml, for another machine or another time." : obstacle);
    if (!isRunning) return;
    ImGui::SameLine();
    ImGui::BeginDisabled(bench.study->isEnding);
    if (button(bench, bench.study->isEnding ? "Ending" : "Cancel", "study.cancel"))
        bench.studies->cancel();
    ImGui::EndDisabled();
}

// How far the study is, or how it ended.
std::string progressText(const StudyState& study) {
    const std::size_t done = study.finished();
    const std::size_t all = study.runs.size();
    std::string text = fmt::format("{} of {} runs", done, all);
    if (study.isRunning && done > 0) {
        text += fmt::format(", {} more", durationText(study.runSeconds / static_cast<double>(done) *
                                                      static_cast<double>(all - done)));
    }
    return text;
}

// Whether it could not even be written, into a folder that is no longer the one for recordings.
bool isForgotten(const StudyState& study, const std::filesystem::path& folder) {
    return !study.isRunning && study.experiment.empty() &&
           study.folder != folder / study.folder.filename();
}

void drawProgress(Bench& bench) {
    const StudyState& study = *bench.study;
    if (study.runs.empty() || isForgotten(study, recordFolder(bench.panels))) return;
    ImGui::Separator();
    const std::string text = progressText(study);
    const float share =
        static_cast<float>(study.finished()) / static_cast<float>(study.runs.size());
    ImGui::ProgressBar(share, {-FLT_MIN, 0.0f}, text.c_str());
    bench.map.control("study.progress",
                      fmt::format("{}: {}", study.isRunning ? "busy" : "idle", text));
    tooltip(study.experiment);
    const bool isCut = !study.isRunning && study.finished() < study.runs.size();
    std::string remark = study.problem;
    if (remark.empty() && isCut) {
        remark = fmt::format("Cancelled; `{}` does the rest.", resumeCommand(study));
    } else if (remark.empty() && !study.isRunning) {
        remark = fmt::format("Its results are in {}; `kaustik experiment report {}` draws them.",
                             study.folder.string(), shellWord(study.folder.string()));
    }
    if (remark.empty()) return;
    ImGui::PushTextWrapPos(0.0f);
    if (study.problem.empty()) {
        ImGui::TextDisabled("%s", remark.c_str());
    } else {
        ImGui::TextColored(kProblemColor, "%s", remark.c_str());
    }
    ImGui::PopTextWrapPos();
    bench.map.control("study.remark", remark);
}

// The study's view with the settings of one of its runs.
void openRun(Bench& bench, const StudyState& study, const Variant& variant) {
    const Document& of = study.study.document;
    bench.document.scene = of.scene;
    bench.document.edits = of.edits;
    bench.document.size = of.size;
    bench.edited() = variant;
    bench.view.flipped = -1;
}

void drawResults(Bench& bench) {
    const std::shared_ptr<const StudyState> study = bench.study;
    if (study->finished() == 0) return;
    const ErrorMeasure& measure = chooseMeasure(bench, "study");
    const Document& of = study->study.document;
    const bool isView = bench.document.scene == of.scene && bench.document.edits == of.edits &&
                        bench.document.size == of.size;
    std::vector<PlottedSetting> points;
    std::vector<std::size_t> runs;  // of each point
    std::size_t unjudged = 0;
    for (std::size_t i = 0; i < study->runs.size(); ++i) {
        const StudyRun& run = study->runs[i];
        if (run.status != StudyRun::Status::done) continue;
        const std::optional<double> error = run.error(measure.key);
        if (!error) {
            ++unjudged;
            continue;
        }
        points.push_back({fmt::format("{}", i + 1),
                          variedText(study->study, run.variant),
                          "A run of the study.",
                          {run.frameMs, *error},
                          isView && bench.variantOf(bench.editedIndex()) == run.variant});
        runs.push_back(i);
    }
    if (!points.empty()) {
        const std::vector<std::size_t> front = markFront(points);
        std::optional<std::size_t> clicked =
            drawErrorTimePlot(bench, "study", points, front, measure);
        if (const auto row = drawErrorTimeRows(bench, "study", points, measure)) clicked = row;
        if (clicked) openRun(bench, *study, study->runs[runs[*clicked]].variant);
    }
    ImGui::PushTextWrapPos(0.0f);
    if (unjudged > 0) {
        const std::string text =
            fmt::format("{}{} {} no such error, but {} time{} in the folder's runs.csv.", unjudged,
                        points.empty() ? "" : " more", unjudged == 1 ? "has" : "have",
                        unjudged == 1 ? "its" : "their", unjudged == 1 ? "" : "s");
        ImGui::TextDisabled("%s", text.c_str());
        bench.map.control("study.unjudged", text);
    }
    for (std::size_t i = 0; i < study->runs.size(); ++i) {
        const StudyRun& run = study->runs[i];
        if (run.status != StudyRun::Status::failed) continue;
        const std::string text =
            fmt::format("{}, {}: {}", i + 1, variedText(study->study, run.variant), run.message);
        ImGui::TextColored(kProblemColor, "%s", text.c_str());
        bench.map.control(fmt::format("study.failed.{}", i + 1), text);
    }
    ImGui::PopTextWrapPos();
}

}  // namespace

void drawStudy(Bench& bench) {
    chooseVariant(bench, "study");
    try {
        const std::vector<TypedAxis> typed = drawStudyAxes(bench);
        drawTerms(bench);
        const Intended all = intended(bench, typed);
        drawPlan(bench, all);
        drawButtons(bench, all);
    } catch (const Error& error) {
        ImGui::TextWrapped("%s", error.what());
    }
    drawProgress(bench);
    drawResults(bench);
}

}  // namespace kaustik::gui
