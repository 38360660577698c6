// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"
#include "framework/pipeline/effect.h"

namespace kaustik::gui {
namespace {

bool matches(const params::NamedField& named, const std::string& search) {
    const auto lower = [](std::string text) {
        std::transform(text.begin(), text.end(), text.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        return text;
    };
    return lower(named.fullName + " " + named.field.sentence).find(lower(search)) !=
           std::string::npos;
}

// `reason`: it has no effect; "" where it has.
void drawRow(Bench& bench, const params::ParamSet& params, const params::NamedField& named,
             const std::string& reason) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    const bool isChanged = params.isSetByUser(named.fullName);
    const std::string label = named.fullName.substr(named.fullName.find('.') + 1);
    if (!reason.empty()) {
        ImGui::TextDisabled("%s", label.c_str());
    } else if (isChanged) {
        ImGui::TextColored(ImVec4(1.0f, 0.75f, 0.25f, 1.0f), "%s", label.c_str());
    } else {
        ImGui::TextUnformatted(label.c_str());
    }
    tooltip(reason.empty() ? named.field.sentence
                           : named.field.sentence + ".\n" + sayNoEffect(named.fullName, reason));
    ImGui::TableNextColumn();
    const float unitWidth =
        named.field.unit.empty()
            ? 0.0f
            : ImGui::CalcTextSize(named.field.unit.c_str()).x + 8.0f * bench.scale;
    // There is room for the mark before there is one: a slider that becomes shorter under the hand
    // would jump.
    const float markWidth = ImGui::GetFontSize() * 1.6f;
    ImGui::SetNextItemWidth(
        std::max(40.0f, ImGui::GetContentRegionAvail().x - unitWidth - markWidth));
    const ParameterChange change = drawParameter(bench, named, "##value");
    if (change.changed) bench.edited().assignments[named.fullName] = change.text;
    const auto assigned = [&] {
        const auto found = bench.edited().assignments.find(named.fullName);
        return found == bench.edited().assignments.end() ? std::string() : found->second;
    };
    auto& problems = bench.panels.parameterProblems;
    if (change.problem)
        problems[named.fullName] = {*change.problem, bench.editedIndex(), assigned()};
    if (!named.field.unit.empty()) {
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

}  // namespace

void drawParameters(Bench& bench) {
    PanelState& panels = bench.panels;
    chooseVariant(bench, "parameters");
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize("  all nodes  ").x - ImGui::GetFrameHeight());
    inputText(bench, "##search", "search names and sentences", panels.parameterSearch,
              "parameters.search");
    ImGui::SameLine();
    static_cast<void>(checkbox(bench, "all nodes", panels.showsAllParameters, "parameters.all"));
    tooltip("Also those that have no effect, as of nodes that are not in use.");
    try {
        const params::ParamSet params =
            settingsOf(bench.edited(), bench.document.size, bench.registry).params;
        const scene::SceneNeeds* needs =
            bench.result && bench.result->scene ? &bench.result->scene->needs : nullptr;
        const FrameFacts facts{bench.registry, params, needs};
        const std::vector<graph::PassRecord> noPasses;
        const std::vector<graph::PassRecord>& passes =
            bench.result ? bench.editedResult().passes : noPasses;
        ImGui::BeginChild("list");
        std::string stage;
        bool isTable = false;
        std::vector<params::NamedField> fields = params.all();
        std::stable_sort(fields.begin(), fields.end(), [&](const auto& a, const auto& b) {
            return stageRank(bench.registry, stageOf(a.fullName)) <
                   stageRank(bench.registry, stageOf(b.fullName));
        });
        for (const params::NamedField& named : fields) {
            if (named.fullName.find('.') == std::string::npos) continue;
            // Before there is a frame only what is declared can say so.
            const std::string reason = passes.empty() ? whyNoEffect(facts, named.fullName)
                                                      : whyNoEffect(facts, passes, named.fullName);
            // What a value next to it keeps from having an effect is shown all the same.
            if (!panels.showsAllParameters && reason != named.field.obstacle &&
                !params.isSetByUser(named.fullName)) {
                continue;
            }
            if (!panels.parameterSearch.empty() && !matches(named, panels.parameterSearch))
                continue;
            if (stageOf(named.fullName) != stage) {
                if (isTable) ImGui::EndTable();
                stage = stageOf(named.fullName);
                ImGui::TextColored(stageColor(bench.registry, stage), "%s", stage.c_str());
                isTable = ImGui::BeginTable(stage.c_str(), 2, ImGuiTableFlags_Resizable);
                if (isTable) {
                    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.45f);
                    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.55f);
                }
            }
            if (isTable) drawRow(bench, params, named, reason);
        }
        if (isTable) ImGui::EndTable();
        ImGui::EndChild();
    } catch (const Error& error) {
        ImGui::TextWrapped("%s", error.what());
    }
}

}  // namespace kaustik::gui
