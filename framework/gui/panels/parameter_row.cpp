// SPDX-License-Identifier: MIT
#include "framework/gui/panels/parameter_row.h"

#include <imgui.h>

#include <algorithm>

#include "framework/gui/panels/parameter_control.h"
#include "framework/gui/widgets.h"
#include "framework/pipeline/effect.h"

namespace kaustik::gui {
namespace {

// Of the controls of what has no effect: they can be used all the same.
constexpr float kNoEffectAlpha = 0.5f;

}  // namespace

bool beginParameterTable(const std::string& name) {
    if (!ImGui::BeginTable(name.c_str(), 2, ImGuiTableFlags_Resizable)) return false;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.53f);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.47f);
    return true;
}

void drawParameterRow(Bench& bench, const VariantParameters& all, const params::NamedField& named) {
    const std::string& reason = all.noEffect.at(named.fullName);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    const bool isChanged = all.params.isSetByUser(named.fullName);
    const std::string label = named.fullName.substr(named.fullName.find('.') + 1);
    if (!reason.empty()) {
        ImGui::TextDisabled("%s", label.c_str());
    } else if (isChanged) {
        ImGui::TextColored(ImVec4(1.0f, 0.75f, 0.25f, 1.0f), "%s", label.c_str());
    } else {
        ImGui::TextUnformatted(label.c_str());
    }
    const std::string noEffect = reason.empty() ? "" : sayNoEffect(named.fullName, reason);
    if (!noEffect.empty()) bench.map.control("no_effect." + named.fullName, noEffect);
    tooltip(noEffect.empty() ? named.field.sentence : named.field.sentence + ".\n" + noEffect);
    ImGui::TableNextColumn();
    const float unitWidth =
        named.field.unit.empty()
            ? 0.0f
            : ImGui::CalcTextSize(named.field.unit.c_str()).x + 8.0f * bench.scale;
    // A long one has a line of its own, below the control.
    const float room = ImGui::GetContentRegionAvail().x;
    const bool isUnitBeside = unitWidth < 0.4f * room;
    // There is room for the mark before there is one: a slider that becomes shorter under the hand
    // would jump.
    const float markWidth = ImGui::GetFontSize() * 1.6f;
    ImGui::SetNextItemWidth(std::max(40.0f, room - (isUnitBeside ? unitWidth : 0.0f) - markWidth));
    if (!noEffect.empty()) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, kNoEffectAlpha);
    const ParameterChange change = drawParameter(bench, named, "##value", noEffect);
    if (!noEffect.empty()) ImGui::PopStyleVar();
    if (change.changed) bench.edited().assignments[named.fullName] = change.text;
    const auto assigned = [&] {
        const auto found = bench.edited().assignments.find(named.fullName);
        return found == bench.edited().assignments.end() ? std::string() : found->second;
    };
    auto& problems = bench.panels.parameterProblems;
    if (change.problem)
        problems[named.fullName] = {*change.problem, bench.editedIndex(), assigned()};
    if (!named.field.unit.empty() && isUnitBeside) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", named.field.unit.c_str());
    }
    if (isChanged) {
        ImGui::SameLine();
        if (resetMark(bench, named.fullName, named.defaultText)) {
            bench.edited().assignments.erase(named.fullName);
            problems.erase(named.fullName);
        }
    }
    if (!named.field.unit.empty() && !isUnitBeside)
        ImGui::TextDisabled("%s", named.field.unit.c_str());
    const auto problem = problems.find(named.fullName);
    if (problem == problems.end()) return;
    const PanelState::TypedProblem& typed = problem->second;
    if (typed.sentence.empty() || typed.variant != bench.editedIndex() ||
        typed.assigned != assigned())
        return;
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(kProblemColor, "%s", typed.sentence.c_str());
    ImGui::PopTextWrapPos();
    bench.map.control("problem." + named.fullName, typed.sentence);
}

}  // namespace kaustik::gui
