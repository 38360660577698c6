// SPDX-License-Identifier: MIT
#include "framework/gui/panels/study_axes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

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
std::vector<Variable> variablesOf(Bench& bench) {
    std::vector<Variable> variables = {techniqueVariable(bench, bench.edited())};
    const std::shared_ptr<const VariantParameters> all = bench.editedParameters();
    for (const params::NamedField& named : all->fields) {
        const params::Field& field = named.field;
        if (field.typeName() == "choice" && field.choices.size() < 2) continue;
        if (!all->noEffect.at(named.fullName).empty()) continue;
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

}  // namespace

std::vector<TypedAxis> drawStudyAxes(Bench& bench) {
    const std::vector<Variable> variables = variablesOf(bench);
    std::vector<PanelState::VariedSetting>& axes = bench.panels.studyAxes;
    std::vector<TypedAxis> typed;
    for (std::size_t i = 0; i < axes.size();) {
        TypedAxis axis = typedAxis(axes[i].key, axes[i].text, bench.edited(), bench.registry);
        axis.hasEffect = find(variables, axes[i].key) != nullptr;
        if (drawAxis(bench, variables, axes[i], axis)) {
            axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(i));
            continue;
        }
        typed.push_back(std::move(axis));
        ++i;
    }
    drawMore(bench, variables);
    return typed;
}

}  // namespace kaustik::gui
