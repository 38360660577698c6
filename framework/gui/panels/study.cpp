// SPDX-License-Identifier: MIT
// A study from the settings at hand: what is varied and its values, how many runs that are and what
// they will take, and their errors against their times as they come.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <map>
#include <optional>

#include "framework/core/error.h"
#include "framework/gui/panels/error_time_plot.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/parameter_row.h"
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

// A setting that can be varied, with what there is to say of it.
struct Variable {
    std::string key;
    std::string sentence;
    std::vector<std::string> options;  // empty where it takes numbers
    std::string range;
    std::string unit;
    std::string now;  // its value
};

Variable techniqueVariable(const Bench& bench, const Variant& variant) {
    Variable variable{kTechniqueKey, "Technique", {}, "", "", variant.technique};
    for (const Technique& technique : bench.registry.techniques())
        variable.options.push_back(technique.name);
    return variable;
}

// What has an effect now, a stage's choice of node among it.
std::vector<Variable> variablesOf(const Bench& bench, const Variant& variant) {
    std::vector<Variable> variables = {techniqueVariable(bench, variant)};
    const params::ParamSet params = settingsOf(variant, bench.document.size, bench.registry).params;
    for (const params::NamedField& named : params.all()) {
        const params::Field& field = named.field;
        if (field.typeName() == "choice" && field.choices.size() < 2) continue;
        if (!whyNoEffectNow(bench, params, named.fullName).empty()) continue;
        Variable variable{named.fullName,    field.sentence, field.choices,
                          field.rangeText(), field.unit,     field.text()};
        if (field.typeName() == "bool") variable.options = {"false", "true"};
        variables.push_back(std::move(variable));
    }
    return variables;
}

const Variable* find(const std::vector<Variable>& variables, const std::string& key) {
    const auto found = std::find_if(variables.begin(), variables.end(),
                                    [&](const Variable& variable) { return variable.key == key; });
    return found != variables.end() ? &*found : nullptr;
}

// Names to click instead of a text; of the text only their order comes.
void drawOptions(Bench& bench, const Variable& variable, const StudyAxis& axis, std::string& text) {
    std::vector<std::string> chosen = axis.values;
    bool isFirst = true;
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    for (const std::string& option : variable.options) {
        const float width =
            ImGui::CalcTextSize(option.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
        if (!isFirst && ImGui::GetItemRectMax().x + 4.0f + width <= end)
            ImGui::SameLine(0.0f, 4.0f);
        isFirst = false;
        const auto found = std::find(chosen.begin(), chosen.end(), option);
        const bool isOn = found != chosen.end();
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(isOn ? ImGuiCol_ButtonActive
                                                                             : ImGuiCol_FrameBg));
        const bool isPressed = ImGui::SmallButton((option + "##" + variable.key).c_str());
        ImGui::PopStyleColor();
        bench.map.control(fmt::format("study.value.{}.{}", variable.key, option), isOn ? "on" : "");
        if (!isPressed) continue;
        if (isOn) {
            chosen.erase(found);
        } else {
            chosen.push_back(option);
        }
        text = fmt::format("{}", fmt::join(chosen, " "));
        return;
    }
}

// True where the axis is to go.
bool drawAxis(Bench& bench, const std::vector<Variable>& variables,
              PanelState::VariedSetting& varied, const TypedAxis& typed) {
    const Variable* variable = find(variables, varied.key);
    const bool isGone = ImGui::SmallButton(("×##" + varied.key).c_str());
    bench.map.control("study.drop." + varied.key);
    tooltip("No longer varied.");
    ImGui::SameLine();
    ImGui::TextColored(stageColor(bench.registry, stageOf(varied.key)), "%s", varied.key.c_str());
    std::string explanation = varied.key;
    if (variable != nullptr) {
        explanation += "\n" + variable->sentence;
        if (!variable->unit.empty()) explanation += "\nUnit: " + variable->unit;
        if (!variable->range.empty()) explanation += "\nRange: " + variable->range;
        explanation += "\nNow: " + variable->now;
    }
    tooltip(explanation);
    if (variable != nullptr && !variable->unit.empty()) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", variable->unit.c_str());
    }
    if (variable != nullptr && !variable->options.empty()) {
        drawOptions(bench, *variable, typed.axis, varied.text);
    } else {
        ImGui::SetNextItemWidth(-FLT_MIN);
        inputText(bench, ("##values" + varied.key).c_str(), "values, a blank between two",
                  varied.text, "study.values." + varied.key);
    }
    std::string problem = typed.problem;
    if (problem.empty() && variable == nullptr)
        problem = "With the settings at hand it has no effect.";
    if (!problem.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(kProblemColor, "%s", problem.c_str());
        ImGui::PopTextWrapPos();
    }
    bench.map.control("study.problem." + varied.key, problem);
    return isGone;
}

void drawMore(Bench& bench, const std::vector<Variable>& variables) {
    std::vector<std::string> names;
    std::vector<const Variable*> free;
    for (const Variable& variable : variables) {
        const auto& axes = bench.panels.studyAxes;
        if (std::any_of(axes.begin(), axes.end(),
                        [&](const auto& varied) { return varied.key == variable.key; }))
            continue;
        names.push_back(variable.key);
        free.push_back(&variable);
    }
    int index = -1;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(bench.panels.studyAxes.empty() ? "Vary" : "and");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (choose(bench, "##vary", names, index, "study.vary", "a setting")) {
        const Variable& chosen = *free[static_cast<std::size_t>(index)];
        bench.panels.studyAxes.push_back({chosen.key, chosen.now});
    }
    tooltip(
        "A setting of the variant at hand that has an effect now: a parameter, a stage's node, the "
        "technique.");
}

// What is set up in the panel.
struct Intended {
    Study study;
    ExperimentTerms terms;
    std::size_t runs = 0;
    std::string obstacle;  // why it cannot be run
};

Intended intended(const Bench& bench, const std::vector<TypedAxis>& typed) {
    Intended all;
    all.study.document = bench.document;
    all.study.document.variant = bench.variantOf(bench.editedIndex());
    all.study.document.other.reset();
    for (const TypedAxis& axis : typed) {
        all.study.axes.push_back(axis.axis);
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
    ImGui::InputInt("frames each", &panels.studyFrames);
    panels.studyFrames = std::clamp(panels.studyFrames, 1, 10000);
    bench.map.control("study.frames", fmt::format("{}", panels.studyFrames));
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
        bench.studies->start(all.study, all.terms, bench.registry, bench.panels.recordFolder, name);
    }
    ImGui::EndDisabled();
    tooltip(obstacle.empty()
                ? fmt::format("Writes it into {} and runs it: 'kaustik experiment run'.",
                              bench.panels.recordFolder)
                : obstacle);
    ImGui::SameLine();
    ImGui::BeginDisabled(!obstacle.empty());
    if (button(bench, "Save", "study.save")) {
        try {
            const std::string file =
                writeStudy(all.study, bench.registry, bench.panels.recordFolder, name, all.terms)
                    .front()
                    .string();
            bench.notify(fmt::format("Wrote {}; 'kaustik experiment run {}' does it.", file, file));
        } catch (const std::exception& error) {
            bench.notify(error.what(), true);
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

void drawProgress(Bench& bench) {
    const StudyState& study = *bench.study;
    if (study.runs.empty()) return;
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
        remark =
            fmt::format("Cancelled; 'kaustik experiment run {} --out {} --resume' does the rest.",
                        study.experiment, study.folder.string());
    } else if (remark.empty() && !study.isRunning) {
        remark = fmt::format("Its results are in {}; 'kaustik experiment report {}' draws them.",
                             study.folder.string(), study.folder.string());
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
            fmt::format("{} more {} no such error, but {} time{} in the folder's runs.csv.",
                        unjudged, unjudged == 1 ? "has" : "have", unjudged == 1 ? "its" : "their",
                        unjudged == 1 ? "" : "s");
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
        const Variant& variant = bench.variantOf(bench.editedIndex());
        const std::vector<Variable> variables = variablesOf(bench, variant);
        std::vector<PanelState::VariedSetting>& axes = bench.panels.studyAxes;
        std::vector<TypedAxis> typed;
        for (std::size_t i = 0; i < axes.size();) {
            TypedAxis axis = typedAxis(axes[i].key, axes[i].text, variant, bench.registry);
            if (drawAxis(bench, variables, axes[i], axis)) {
                axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(i));
                continue;
            }
            typed.push_back(std::move(axis));
            ++i;
        }
        drawMore(bench, variables);
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
