// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "framework/gui/panels/panels.h"
#include "framework/gui/pass_graph.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

const ImVec4 kGrey(0.5f, 0.5f, 0.5f, 1.0f);
const ImVec4 kBad(1.0f, 0.45f, 0.4f, 1.0f);
// Of the panel's height, what the table has while one of its passes is looked at.
constexpr float kTableShare = 0.4f;

void drawSwitch(Bench& bench, const graph::PassRecord& pass) {
    const bool isNeeded =
        pass.state == graph::PassState::ran || pass.state == graph::PassState::bypassed;
    if (!isNeeded) return;
    const bool isLocked = pass.bypass.empty();
    bool isOn = !bench.edited().disabled.contains(pass.name);
    ImGui::BeginDisabled(isLocked);
    if (checkbox(bench, ("##on" + pass.name).c_str(), isOn, "passes.on." + pass.name)) {
        if (isOn) {
            bench.edited().disabled.erase(pass.name);
        } else {
            bench.edited().disabled.insert(pass.name);
        }
    }
    ImGui::EndDisabled();
    tooltip(isLocked ? "Required: nothing stands in for what it makes."
                     : "When it is off: " + pass.bypass + ".");
}

// Over all the columns that have no numbers here, on as many lines as it takes.
void drawReason(Bench& bench, const graph::PassRecord& pass) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x - corner.x;
    const char* text = pass.reason.c_str();
    const float height = ImGui::CalcTextSize(text, nullptr, false, width).y;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 clipLow = draw.GetClipRectMin();  // of the column: below the header
    const ImVec2 clipHigh = draw.GetClipRectMax();
    draw.PushClipRect({corner.x, clipLow.y}, {corner.x + width, clipHigh.y});
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), corner, ImGui::GetColorU32(kGrey), text,
                 nullptr, width);
    draw.PopClipRect();
    ImGui::Dummy({0.0f, height});
    bench.map.area("passes.why." + pass.name, corner.x, corner.y, width, height, pass.reason);
}

void drawPassRow(Bench& bench, const VariantResult& result, const graph::PassRecord& pass,
                 double frameMs) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    drawSwitch(bench, pass);
    ImGui::TableNextColumn();
    const std::string name = pass.name.substr(std::min(pass.name.find('.') + 1, pass.name.size()));
    const std::string label = pass.repeats > 1 ? fmt::format("{} ×{}", name, pass.repeats) : name;
    const report::PassTimes* times =
        pass.state == graph::PassState::ran ? timesOf(result, pass.name) : nullptr;
    const bool hasRun = pass.state == graph::PassState::ran;
    const bool isChosen = bench.view.pass == pass.name;
    if (!hasRun) ImGui::PushStyleColor(ImGuiCol_Text, kGrey);
    if (ImGui::Selectable(fmt::format("{}##{}", label, pass.name).c_str(), isChosen))
        bench.view.pass = isChosen ? "" : pass.name;
    if (!hasRun) ImGui::PopStyleColor();
    bench.map.control("passes.name." + pass.name, nameOf(pass.state));
    tooltip(fmt::format("{}\n{}\nA click shows what it reads and writes, and its parameters.",
                        pass.name, pass.reason));
    if (times == nullptr) {
        ImGui::TableNextColumn();
        drawReason(bench, pass);
        return;
    }
    const double median = settledMedianOf(times->gpuMilliseconds);
    ImGui::TableNextColumn();
    ImGui::Text("%.2f", median);
    bench.map.control("passes.median." + pass.name, fmt::format("{:.4f}", median));
    if (ImGui::TableNextColumn()) ImGui::Text("%.2f", times->gpuMilliseconds.back());
    if (ImGui::TableNextColumn())
        ImGui::Text("%.0f%%", frameMs > 0.0 ? 100.0 * median / frameMs : 0.0);
    if (ImGui::TableNextColumn()) ImGui::Text("%.2f", times->cpuMilliseconds.back());
    if (ImGui::TableNextColumn()) {
        const float height = ImGui::GetTextLineHeight();
        sparkline(times->gpuMilliseconds, {ImGui::GetContentRegionAvail().x, height});
    }
}

// As many columns as there is room for, the most telling first.
void setUpColumns() {
    const float number = ImGui::CalcTextSize("GPU ms").x;
    const float gap = 2.0f * ImGui::GetStyle().CellPadding.x;
    float room = ImGui::GetContentRegionAvail().x;
    const auto column = [&](const char* name, float width) {
        room -= width + gap;
        ImGui::TableSetupColumn(name, room < 0.0f ? ImGuiTableColumnFlags_Disabled : 0, width);
    };
    column("on", ImGui::GetFrameHeight());
    column("pass", ImGui::GetFontSize() * 8.0f);
    column("median", number);
    column("GPU ms", number);
    column("share", ImGui::CalcTextSize("share").x);
    column("CPU ms", number);
    const bool hasRoom = room > 2.0f * ImGui::GetFontSize();
    ImGui::TableSetupColumn(
        "", hasRoom ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_Disabled);
}

// Where no frame tells which passes there are: what is off can be switched on again here.
void drawSwitchedOff(Bench& bench, const VariantResult& result) {
    if (result.error.empty()) return;
    std::string turnedOn;
    for (const std::string& name : bench.edited().disabled) {
        if (button(bench, fmt::format("Forget that {} is off", name).c_str(),
                   "passes.forget." + name)) {
            turnedOn = name;
        }
    }
    if (!turnedOn.empty()) bench.edited().disabled.erase(turnedOn);
}

void drawSummary(Bench& bench, const VariantResult& result) {
    const double median = settledMedianOf(result.frameMs);
    if (!result.frameMs.empty()) {
        // As many decimals each time: a line that wraps now and then moves what is under the mouse.
        ImGui::TextWrapped(
            "%s", fmt::format("Frame {:.1f} ms, median {:.1f} ms", result.frameMs.back(), median)
                      .c_str());
    } else {
        ImGui::TextUnformatted("No frame yet.");
    }
    bench.map.control("passes.frame", fmt::format("{:.4f}", median));
    tooltip(
        fmt::format("The newest frame, and the median of {}. Peak memory of textures and buffers: "
                    "{:.1f} MiB.",
                    std::max<std::size_t>(result.frameMs.size(), 2) - 1,
                    static_cast<double>(result.peakBytes) / (1 << 20)));
    static_cast<void>(checkbox(bench, "Keep rendering", bench.panels.isEndless, "passes.endless"));
    tooltip(
        "Renders on although nothing changes, to watch the times. Otherwise a few frames are "
        "rendered after each change.");
    sameLineWithRoom(ImGui::CalcTextSize("Finish each pass").x + ImGui::GetFrameHeight() +
                     ImGui::GetStyle().ItemInnerSpacing.x);
    static_cast<void>(
        checkbox(bench, "Finish each pass", bench.panels.isPrecise, "passes.precise"));
    tooltip(
        "Waits for the device around each pass instead of reading timestamps: what --precise "
        "does, and what a software rasteriser needs for true times.");
}

// What a frame takes outside of its passes, so that all shares add up.
void drawRest(Bench& bench, const VariantResult& result, double frameMs) {
    double ofPasses = 0.0;
    for (const report::PassTimes& times : result.times) {
        if (!times.gpuMilliseconds.empty()) ofPasses += settledMedianOf(times.gpuMilliseconds);
    }
    const double rest = frameMs - ofPasses;
    if (!(frameMs > 0.0)) return;
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(1);
    ImGui::TextColored(kGrey, "the rest");
    bench.map.control("passes.rest", fmt::format("{:.4f}", rest));
    tooltip(
        "Between passes: building the graph, memory, and waiting. Medians are of each by itself, "
        "so "
        "that it may be below 0.");
    ImGui::TableNextColumn();
    ImGui::Text("%.2f", rest);
    ImGui::TableNextColumn();
    if (ImGui::TableNextColumn()) ImGui::Text("%.0f%%", 100.0 * rest / frameMs);
}

// Ends the table that has been begun.
void drawRows(Bench& bench, const VariantResult& result) {
    ImGui::TableSetupScrollFreeze(0, 1);
    setUpColumns();
    ImGui::TableHeadersRow();
    const double frameMs = settledMedianOf(result.frameMs);
    std::string stage;
    for (const graph::PassRecord& pass : result.passes) {
        if (stageOf(pass.name) != stage) {
            stage = stageOf(pass.name);
            ImGui::TableNextRow();
            ImGui::TableSetColumnIndex(1);
            ImGui::TextColored(stageColor(bench.registry, stage), "%s", stage.c_str());
        }
        drawPassRow(bench, result, pass, frameMs);
    }
    drawRest(bench, result, frameMs);
    ImGui::EndTable();
}

}  // namespace

void drawPasses(Bench& bench) {
    chooseVariant(bench, "passes");
    const VariantResult& result = bench.editedResult();
    drawSummary(bench, result);
    if (!result.error.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(kBad, "%s", result.error.c_str());
        ImGui::PopTextWrapPos();
        bench.map.control("passes.error", result.error);
    }
    drawSwitchedOff(bench, result);
    drawTableButtons(bench, "passes", passTable(result));
    ImGui::SameLine();
    if (ImGui::SmallButton(bench.panels.showsGraph ? "picture" : "graph"))
        bench.panels.showsGraph = !bench.panels.showsGraph;
    bench.map.control("passes.graph", bench.panels.showsGraph ? "on" : "off");
    tooltip("The passes and what flows between them, in the place of the picture (G).");
    const auto chosen =
        std::find_if(result.passes.begin(), result.passes.end(),
                     [&](const graph::PassRecord& pass) { return pass.name == bench.view.pass; });
    const bool hasChosen = chosen != result.passes.end();
    const float height =
        hasChosen ? std::max(kTableShare * ImGui::GetContentRegionAvail().y, 60.0f) : 0.0f;
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (ImGui::BeginTable("passes", 7, kFlags, {0.0f, height})) drawRows(bench, result);
    if (!hasChosen) return;
    ImGui::Separator();
    // A copy: a click may choose another one.
    const graph::PassRecord pass = *chosen;
    drawPassDetail(bench, pass);
}

}  // namespace kaustik::gui
