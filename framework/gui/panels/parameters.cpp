// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cfloat>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/parameter_row.h"
#include "framework/gui/widgets.h"

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

// The settings that the variant has without anything that was set by hand.
params::ParamSet defaultsOf(const Bench& bench, const Variant& variant) {
    const Variant untouched{variant.technique, {}, {}, variant.isAsPublished};
    return settingsOf(untouched, bench.document.size, bench.registry).params;
}

// What is in the list, and how many are not because they have no effect.
struct Choice {
    std::vector<const params::NamedField*> fields;
    int leftOut = 0;
};

Choice chosenOf(const Bench& bench, const VariantParameters& all) {
    const PanelState& panels = bench.panels;
    std::optional<params::ParamSet> defaults;
    if (panels.showsChangedParameters)
        defaults = defaultsOf(bench, bench.variantOf(bench.editedIndex()));
    Choice choice;
    for (const params::NamedField& named : all.fields) {
        const std::string& name = named.fullName;
        if (defaults) {
            if (defaults->find(name).text() == named.field.text()) continue;
        } else if (name.find('.') == std::string::npos) {
            continue;  // a stage's node, which the panel Technique has
        }
        if (!panels.parameterSearch.empty() && !matches(named, panels.parameterSearch)) continue;
        // What a value next to it keeps from having an effect is shown all the same.
        if (!defaults && !panels.showsAllParameters &&
            all.noEffect.at(name) != named.field.obstacle && !all.params.isSetByUser(name)) {
            ++choice.leftOut;
            continue;
        }
        choice.fields.push_back(&named);
    }
    std::stable_sort(choice.fields.begin(), choice.fields.end(), [&](const auto* a, const auto* b) {
        return stageRank(bench.registry, stageOf(a->fullName)) <
               stageRank(bench.registry, stageOf(b->fullName));
    });
    return choice;
}

void drawList(Bench& bench, const VariantParameters& all, const Choice& choice) {
    std::string stage;
    bool isTable = false;
    for (const params::NamedField* named : choice.fields) {
        if (stageOf(named->fullName) != stage) {
            if (isTable) ImGui::EndTable();
            stage = stageOf(named->fullName);
            ImGui::TextColored(stageColor(bench.registry, stage), "%s", stage.c_str());
            isTable = beginParameterTable(stage);
        }
        if (isTable) drawParameterRow(bench, all, *named);
    }
    if (isTable) ImGui::EndTable();
}

// Why the list of what differs is short.
std::string remarkOn(const Bench& bench, const Choice& choice) {
    const PanelState& panels = bench.panels;
    const Variant& variant = bench.variantOf(bench.editedIndex());
    if (!panels.showsChangedParameters) return "";
    if (!variant.disabled.empty()) {
        return fmt::format("Switched off: {}.",
                           joinNames({variant.disabled.begin(), variant.disabled.end()}));
    }
    if (!choice.fields.empty()) return "";
    return panels.parameterSearch.empty()
               ? fmt::format("Nothing differs from the default of {}.", variant.technique)
               : "Nothing that matches differs from the default.";
}

}  // namespace

void drawParameters(Bench& bench) {
    PanelState& panels = bench.panels;
    chooseVariant(bench, "parameters");
    ImGui::SetNextItemWidth(-FLT_MIN);
    inputText(bench, "##search", "search names and sentences", panels.parameterSearch,
              "parameters.search");
    static_cast<void>(
        checkbox(bench, "changed", panels.showsChangedParameters, "parameters.changed"));
    tooltip("Just what differs from the technique's default.");
    ImGui::SameLine();
    ImGui::BeginDisabled(panels.showsChangedParameters);
    static_cast<void>(checkbox(bench, "all nodes", panels.showsAllParameters, "parameters.all"));
    ImGui::EndDisabled();
    tooltip(
        "Also those that have no effect, as of nodes that are not in use; grey, and a tooltip "
        "says why.");
    try {
        const std::shared_ptr<const VariantParameters> all = bench.editedParameters();
        const Choice choice = chosenOf(bench, *all);
        if (choice.leftOut > 0) {
            ImGui::SameLine();
            ImGui::TextDisabled("%d left out", choice.leftOut);
            bench.map.control("parameters.left_out", fmt::format("{}", choice.leftOut));
            tooltip("They have no effect now; 'all nodes' lists them with the reason.");
        }
        if (const std::string remark = remarkOn(bench, choice); !remark.empty()) {
            ImGui::PushTextWrapPos(0.0f);
            ImGui::TextDisabled("%s", remark.c_str());
            ImGui::PopTextWrapPos();
            bench.map.control("parameters.remark", remark);
        }
        ImGui::BeginChild("list");
        drawList(bench, *all, choice);
        ImGui::EndChild();
    } catch (const Error& error) {
        ImGui::TextWrapped("%s", error.what());
    }
}

}  // namespace kaustik::gui
