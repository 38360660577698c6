// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/core/error.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/picture_choice.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

std::string explain(const NodeDescription& description) {
    return description.source.empty()
               ? description.sentence
               : fmt::format("{}\n{}", description.sentence, description.source);
}

// Each with the scene at hand, as its file has it.
void drawTechniquePictures(Bench& bench) {
    std::vector<PictureOption> options;
    for (const Technique& technique : bench.registry.techniques()) {
        options.push_back(
            {technique.name, technique.sentence, {bench.document.scene, technique.name}});
    }
    const std::string title =
        fmt::format("A technique by its picture of {}, as its file has it",
                    std::filesystem::path(bench.document.scene).filename().string());
    if (const auto chosen =
            chooseByPicture(bench, "technique.pictures", title, options, bench.edited().technique))
        bench.edited().technique = options[*chosen].name;
}

void drawTechniqueChoice(Bench& bench) {
    std::vector<std::string> names;
    int index = 0;
    for (const Technique& technique : bench.registry.techniques()) {
        if (technique.name == bench.edited().technique) index = static_cast<int>(names.size());
        names.push_back(technique.name);
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (choose(bench, "##technique", names, index, "technique")) {
        // Another technique has other defaults; what was set by hand stays where it still exists.
        bench.edited().technique = names[static_cast<std::size_t>(index)];
    }
    const Technique& technique = bench.registry.findTechnique(bench.edited().technique);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("%s %s", technique.sentence.c_str(), technique.source.c_str());
    ImGui::PopTextWrapPos();
    const bool hasPaper = !technique.asPublished.empty();
    if (!hasPaper) bench.edited().isAsPublished = false;
    drawTechniquePictures(bench);
    ImGui::SameLine();
    ImGui::BeginDisabled(!hasPaper);
    bool isAsPublished = bench.edited().isAsPublished;
    if (checkbox(bench, "As published", isAsPublished, "technique.as_published"))
        bench.edited().isAsPublished = isAsPublished;
    ImGui::EndDisabled();
    tooltip("The method as its paper has it to the letter, in place of what is right.");
}

void drawStage(Bench& bench, const params::ParamSet& params, const Registry::StageEntry& of) {
    const std::string& stage = of.name;
    std::vector<std::string> names;
    const std::string chosen = params.choice(stage);
    int index = 0;
    std::string explanation;
    for (const Registry::Node& node : bench.registry.nodes()) {
        if (node.stage != stage) continue;
        if (node.name == chosen) {
            index = static_cast<int>(names.size());
            explanation = explain(node.description);
        }
        names.push_back(node.name);
    }
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(stageColor(bench.registry, stage), "%s", stage.c_str());
    tooltip(of.question);
    ImGui::TableNextColumn();
    if (params.isSetByUser(stage)) {
        if (resetMark(bench, stage, "the technique's own")) bench.edited().assignments.erase(stage);
        ImGui::SameLine();
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::BeginDisabled(names.size() == 1);
    if (choose(bench, ("##stage" + stage).c_str(), names, index, "stage." + stage))
        bench.edited().assignments[stage] = names[static_cast<std::size_t>(index)];
    ImGui::EndDisabled();
    tooltip(explanation);
}

void drawVariants(Bench& bench) {
    Document& document = bench.document;
    ImGui::Separator();
    ImGui::TextUnformatted("Side by side");
    if (!document.other) {
        if (button(bench, "Keep this as B and go on with A", "variant.keep")) {
            document.other = document.variant;
            bench.view.comparedWith = ComparedImage::other;
        }
        tooltip("Renders both from then on, A left and B right of the split.");
        return;
    }
    if (button(bench, "Swap A and B", "variant.swap")) {
        std::swap(document.variant, *document.other);
        std::swap(bench.histories[0], bench.histories[1]);
    }
    ImGui::SameLine();
    if (button(bench, "Drop B", "variant.drop")) {
        document.other.reset();
        bench.panels.edited = 0;
        if (bench.view.comparedWith == ComparedImage::other)
            bench.view.comparedWith = ComparedImage::none;
        return;
    }
    if (ImGui::BeginTable("variants", 3, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("");
        ImGui::TableSetupColumn("A");
        ImGui::TableSetupColumn("B");
        ImGui::TableHeadersRow();
        const auto row = [&](const std::string& name, const std::string& a, const std::string& b) {
            ImGui::TableNextRow();
            for (const std::string& cell : {name, a, b}) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(cell.c_str());
            }
        };
        row("frame", fmt::format("{:.1f} ms", settledMedianOf(bench.result->variants[0].frameMs)),
            fmt::format("{:.1f} ms", settledMedianOf(bench.result->variants[1].frameMs)));
        bench.map.area("variant.table", 0, 0, 0, 0,
                       fmt::format("{:.4f}", settledMedianOf(bench.result->variants[1].frameMs)));
        std::set<std::string> names;
        for (const auto& [name, value] : document.variant.assignments)
            names.insert(name);
        for (const auto& [name, value] : document.other->assignments)
            names.insert(name);
        const auto valueIn = [](const Variant& variant, const std::string& name) {
            const auto found = variant.assignments.find(name);
            return found == variant.assignments.end() ? std::string("default") : found->second;
        };
        for (const std::string& name : names) {
            const std::string a = valueIn(document.variant, name);
            const std::string b = valueIn(*document.other, name);
            if (a != b) row(name, a, b);
        }
        std::set<std::string> disabled = document.variant.disabled;
        disabled.insert(document.other->disabled.begin(), document.other->disabled.end());
        for (const std::string& pass : disabled) {
            const bool isOffInA = document.variant.disabled.contains(pass);
            const bool isOffInB = document.other->disabled.contains(pass);
            if (isOffInA != isOffInB) row(pass, isOffInA ? "off" : "on", isOffInB ? "off" : "on");
        }
        ImGui::EndTable();
    }
}

}  // namespace

void drawTechnique(Bench& bench) {
    chooseVariant(bench, "variant");
    drawTechniqueChoice(bench);
    try {
        const std::shared_ptr<const VariantParameters> all = bench.editedParameters();
        if (ImGui::BeginTable("stages", 2)) {
            ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed,
                                    ImGui::GetFontSize() * 7.0f);
            ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
            for (const Registry::StageEntry& stage : bench.registry.stages())
                drawStage(bench, all->params, stage);
            ImGui::EndTable();
        }
    } catch (const Error& error) {
        // A setting that this technique does not have.
        ImGui::TextWrapped("%s", error.what());
        if (button(bench, "Forget all settings", "technique.forget"))
            bench.edited().assignments.clear();
    }
    drawVariants(bench);
}

}  // namespace kaustik::gui
