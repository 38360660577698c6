// SPDX-License-Identifier: MIT
// Where everything stands in the workbench's window: one line with the toolbar and what is shown,
// the picture with all the room that panels to its left and right and the time chart leave.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <vector>

#include "framework/gui/panels/panels.h"
#include "framework/gui/showing.h"
#include "framework/gui/shown.h"
#include "framework/gui/widgets.h"
#include "framework/gui/workbench.h"

namespace kaustik::gui {

namespace {

struct Tab {
    const char* name;
    void (*draw)(Bench&);
};

constexpr std::array<Tab, 10> kTabs = {{{"Passes", drawPasses},
                                        {"Technique", drawTechnique},
                                        {"Scene", drawScene},
                                        {"Parameters", drawParameters},
                                        {"Image", drawImage},
                                        {"Error", drawError},
                                        {"Trade-off", drawTradeOff},
                                        {"Study", drawStudy},
                                        {"Compare", drawCompare},
                                        {"Record", drawRecord}}};

// Names of panels in as many lines as they need, so that none is cut.
void drawTabs(Bench& bench, const std::vector<const Tab*>& tabs, std::string& open) {
    bool isFirst = true;
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    for (const Tab* tab : tabs) {
        const float width =
            ImGui::CalcTextSize(tab->name).x + 2.0f * ImGui::GetStyle().FramePadding.x;
        const float space = ImGui::GetStyle().ItemSpacing.x;
        if (!isFirst && ImGui::GetItemRectMax().x + space + width <= end) ImGui::SameLine();
        isFirst = false;
        const bool isOpen = open == tab->name;
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(isOpen ? ImGuiCol_TabActive : ImGuiCol_Tab));
        if (ImGui::Button(tab->name)) open = tab->name;
        ImGui::PopStyleColor();
        bench.map.control(std::string("tab.") + tab->name, isOpen ? "open" : "");
    }
}

// One of the two areas, with the panels that are in it.
void drawSide(Bench& bench, bool isLeft, ImVec2 size) {
    PanelState& panels = bench.panels;
    std::vector<const Tab*> tabs;
    for (const Tab& tab : kTabs) {
        if (panels.leftTabs.contains(tab.name) == isLeft) tabs.push_back(&tab);
    }
    const ImVec2 padding(5.0f * bench.scale, 8.0f * bench.scale);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::BeginChild(isLeft ? "left" : "right", size, true);
    ImGui::PopStyleVar();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(6.0f * bench.scale, 4.0f * bench.scale));
    std::string& open = isLeft ? panels.leftTab : panels.rightTab;
    const auto found =
        std::find_if(tabs.begin(), tabs.end(), [&](const Tab* tab) { return open == tab->name; });
    const Tab* shown = found != tabs.end() ? *found : tabs.empty() ? nullptr : tabs.front();
    if (shown != nullptr) open = shown->name;
    drawTabs(bench, tabs, open);
    if (shown != nullptr) {
        if (!tabs.empty()) {
            sameLineWithRoom(ImGui::CalcTextSize("←").x + 2.0f * ImGui::GetStyle().FramePadding.x);
        }
        const bool isMoved = ImGui::SmallButton(isLeft ? "→##move" : "←##move");
        bench.map.control(isLeft ? "panel.to_right" : "panel.to_left");
        tooltip(fmt::format("Moves {} to the other side of the picture.", shown->name));
        ImGui::Separator();
        ImGui::BeginChild(shown->name);
        shown->draw(bench);
        ImGui::EndChild();
        if (isMoved && isLeft) {
            panels.leftTabs.erase(shown->name);
            panels.rightTab = shown->name;
            panels.isRightOpen = true;
        } else if (isMoved) {
            panels.leftTabs.insert(shown->name);
            panels.leftTab = shown->name;
            panels.isLeftOpen = true;
        }
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

void toggle(Bench& bench, const char* label, bool& isOpen, const char* name, const char* key) {
    ImGui::SameLine(0.0f, 3.0f * bench.scale);
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(isOpen ? ImGuiCol_ButtonActive
                                                                           : ImGuiCol_FrameBg));
    if (ImGui::Button(label)) isOpen = !isOpen;
    ImGui::PopStyleColor();
    bench.map.control(name, isOpen ? "open" : "");
    tooltip(fmt::format("Shows or hides it; {}. H hides all.", key));
}

}  // namespace

void Workbench::drawToolbar() {
    if (button(bench_, bench_.isPlaying ? "Pause" : " Play ", "toolbar.play"))
        bench_.isPlaying = !bench_.isPlaying;
    ImGui::SameLine(0.0f, 3.0f * bench_.scale);
    if (button(bench_, "Undo", "toolbar.undo")) undo(-1);
    ImGui::SameLine(0.0f, 3.0f * bench_.scale);
    if (button(bench_, "Redo", "toolbar.redo")) undo(1);
    ImGui::SameLine(0.0f, 3.0f * bench_.scale);
    if (button(bench_, "Fit", "toolbar.fit")) bench_.view.zoom = 0.0f;
    tooltip("The whole picture (0)");
    ImGui::SameLine(0.0f, 3.0f * bench_.scale);
    if (button(bench_, "1:1", "toolbar.one_to_one")) {
        bench_.view.zoom = 1.0f;
        bench_.view.middle = glm::vec2(0.5f);
    }
    toggle(bench_, "◧", bench_.panels.isLeftOpen, "toolbar.left", "F2");
    toggle(bench_, "◨", bench_.panels.isRightOpen, "toolbar.right", "F3");
    toggle(bench_, "▭", bench_.panels.isChartOpen, "toolbar.chart", "F4");
    ImGui::SameLine(0.0f, 3.0f * bench_.scale);
    if (button(bench_, "F1", "toolbar.keys")) bench_.showsHelp = !bench_.showsHelp;
    tooltip("All keys");
    const RenderWorker::Progress progress = renderer_->progress();
    if (progress.isBusy) {
        ImGui::SameLine();
        const std::string text = fmt::format("{}  {:.1f} s", progress.what, progress.seconds);
        ImGui::ProgressBar(static_cast<float>(progress.share.value_or(0.0)),
                           {static_cast<float>(bench_.px(190.0)), 0.0f}, text.c_str());
        bench_.map.control("toolbar.progress",
                           progress.share ? fmt::format("{}", *progress.share) : "");
    }
    ImGui::SameLine();
}

// One line below the picture: values under the mouse, and what there is to say, the newest message
// first, then what the technique says of its picture.
void Workbench::drawStatusBar() {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float line = ImGui::GetTextLineHeight();
    const auto gap = static_cast<float>(bench_.px(16.0));
    std::string words = bench_.message;
    ImU32 color =
        bench_.isMessageBad ? ImGui::GetColorU32(kProblemColor) : ImGui::GetColorU32(ImGuiCol_Text);
    if (words.empty()) {
        const std::vector<std::string> all =
            shownOf(bench_.requested(), *bench_.result, *bench_.reference, bench_.whole)
                .reservations;
        if (!all.empty()) {
            words =
                all.size() == 1 ? all.front() : fmt::format("1 of {}: {}", all.size(), all.front());
            std::replace(words.begin(), words.end(), '\n', ' ');
            color = IM_COL32(255, 205, 90, 255);
            bench_.map.area("picture.reservations", corner.x, corner.y, width, line, words);
        } else {
            words = bench_.result->device.renderer;
            color = ImGui::GetColorU32(ImGuiCol_TextDisabled);
        }
    }
    float x = corner.x + static_cast<float>(bench_.px(4.0));
    const float end = corner.x + width;
    const std::string& value = bench_.valueUnderMouse;
    // Of what the picture is, for who has only that, where nothing newer needs the room.
    std::string identity;
    if (bench_.message.empty()) {
        const Showing showing = showingOf(bench_.requested(), *bench_.result, *bench_.reference);
        if (showing.main) identity = showing.main->identity();
        const std::string other = showing.compared ? showing.compared->identity() : "";
        if (showing.compared && showing.compared->originOfSubtrahend) {
            identity = other;
        } else if (!other.empty() && other != identity) {
            identity += " and " + other;
        }
    }
    if (!value.empty()) {
        const float needed = ImGui::CalcTextSize(value.c_str()).x;
        // Both have a part of the line, the values the larger one.
        const float rest = ImGui::CalcTextSize(words.c_str()).x + gap;
        const float room = std::min(needed, std::max(end - x - rest, 0.65f * (end - x)));
        bench_.map.area("picture.value", x, corner.y, room, line, value);
        cutLine(value, {x, corner.y}, IM_COL32(255, 255, 255, 255), room);
        x += room + gap;
    }
    if (!identity.empty()) {
        const float needed = ImGui::CalcTextSize(identity.c_str()).x;
        const float rest = ImGui::CalcTextSize(words.c_str()).x + gap;
        const float room = std::min(needed, std::max(end - x - rest, 0.6f * (end - x)));
        bench_.map.area("status.identity", x, corner.y, room, line, identity);
        cutLine(identity, {x, corner.y}, ImGui::GetColorU32(ImGuiCol_TextDisabled), room);
        x += room + gap;
    }
    bench_.map.area("status.message", x, corner.y, end - x, line, bench_.message);
    cutLine(words, {x, corner.y}, color, end - x);
}

void Workbench::draw() {
    useKeys();
    const ImGuiViewport* viewport = ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport->WorkPos);
    ImGui::SetNextWindowSize(viewport->WorkSize);
    constexpr ImGuiWindowFlags kWhole =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
        ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
        ImGuiWindowFlags_NoBackground;  // what the window is cleared with, once less
    const float edge = 4.0f * bench_.scale;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {edge, edge});
    ImGui::Begin("workbench", nullptr, kWhole);
    ImGui::PopStyleVar();
    drawToolbar();
    drawShown(bench_);
    const ImVec2 all = ImGui::GetContentRegionAvail();
    const float height = std::max(all.y, 60.0f);
    PanelState& panels = bench_.panels;
    // Whatever the window's size, the picture keeps a part of it.
    const float side = std::max(0.4f * all.x, 60.0f);
    // What the user chose stays, for a larger window.
    panels.leftWidth = std::max(panels.leftWidth, 150.0f);
    panels.rightWidth = std::max(panels.rightWidth, 150.0f);
    panels.chartHeight = std::max(panels.chartHeight, 30.0f);
    const bool hasLeft = panels.isLeftOpen && !panels.leftTabs.empty();
    const bool hasRight = panels.isRightOpen && panels.leftTabs.size() < kTabs.size();
    const float left = hasLeft ? std::min(panels.leftWidth * bench_.scale, side) : 0.0f;
    const float right = hasRight ? std::min(panels.rightWidth * bench_.scale, side) : 0.0f;
    const auto bar = static_cast<float>(bench_.px(5.0));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.0f});
    if (hasLeft) {
        drawSide(bench_, true, {left, height});
        ImGui::SameLine();
        splitter("##left_edge", true, height, panels.leftWidth, 1.0f, bench_);
        ImGui::SameLine();
    }
    ImGui::BeginGroup();
    const float middle =
        std::max(all.x - left - right - (hasLeft ? bar : 0.0f) - (hasRight ? bar : 0.0f), 40.0f);
    const float status = ImGui::GetTextLineHeight() + 2.0f * bench_.scale;
    const float chart = panels.isChartOpen
                            ? std::min(panels.chartHeight * bench_.scale, 0.6f * height) + bar
                            : 0.0f;
    bench_.valueUnderMouse.clear();
    ImGui::BeginChild("middle", {middle, std::max(height - chart - status, 30.0f)});
    if (panels.showsGraph) {
        drawGraph(bench_);
    } else {
        drawPicture(bench_);
    }
    ImGui::EndChild();
    ImGui::BeginChild("status", {middle, status});
    drawStatusBar();
    ImGui::EndChild();
    if (panels.isChartOpen) {
        splitter("##chart_edge", false, middle, panels.chartHeight, -1.0f, bench_);
        ImGui::BeginChild("chart", {middle, chart - bar});
        drawTimeChart(bench_);
        ImGui::EndChild();
    }
    ImGui::EndGroup();
    if (hasRight) {
        ImGui::SameLine();
        splitter("##right_edge", true, height, panels.rightWidth, -1.0f, bench_);
        ImGui::SameLine();
        drawSide(bench_, false, {0.0f, height});
    }
    ImGui::PopStyleVar();
    ImGui::End();
    if (bench_.showsHelp) drawHelp(bench_);
}

}  // namespace kaustik::gui
