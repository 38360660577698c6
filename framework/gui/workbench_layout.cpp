// SPDX-License-Identifier: MIT
// Where everything stands in the workbench's window: one line with the toolbar and what is shown,
// the picture with all the room that panels to its left and right and the time chart leave.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <vector>

#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"
#include "framework/gui/workbench.h"

namespace kaustik::gui {

namespace {

struct Tab {
    const char* name;
    void (*draw)(Bench&);
};

constexpr std::array<Tab, 9> kTabs = {{{"Passes", drawPasses},
                                       {"Technique", drawTechnique},
                                       {"Scene", drawScene},
                                       {"Parameters", drawParameters},
                                       {"Image", drawImage},
                                       {"Error", drawError},
                                       {"Trade-off", drawTradeOff},
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
    ImGui::BeginChild(isLeft ? "left" : "right", size, true);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(6.0f * bench.scale, 4.0f * bench.scale));
    std::string& open = isLeft ? panels.leftTab : panels.rightTab;
    const auto found =
        std::find_if(tabs.begin(), tabs.end(), [&](const Tab* tab) { return open == tab->name; });
    const Tab* shown = found != tabs.end() ? *found : tabs.empty() ? nullptr : tabs.front();
    if (shown != nullptr) open = shown->name;
    drawTabs(bench, tabs, open);
    if (shown != nullptr) {
        if (tabs.size() > 0) ImGui::SameLine();
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

void Workbench::drawStatusBar() {
    const bool isEmpty = bench_.message.empty();
    if (isEmpty) {
        ImGui::TextDisabled("%s", bench_.result->device.renderer.c_str());
    } else if (bench_.isMessageBad) {
        ImGui::TextColored({1.0f, 0.45f, 0.4f, 1.0f}, "%s", bench_.message.c_str());
    } else {
        ImGui::TextUnformatted(bench_.message.c_str());
    }
    bench_.map.control("status.message", bench_.message);
    if (!isEmpty) tooltip(bench_.message);
}

void Workbench::draw() {
    useKeys();
    const ImGuiViewport* viewport = ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport->WorkPos);
    ImGui::SetNextWindowSize(viewport->WorkSize);
    constexpr ImGuiWindowFlags kWhole =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
        ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse;
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
    ImGui::BeginChild("middle", {middle, std::max(height - chart - status, 30.0f)});
    if (panels.showsGraph) {
        drawGraph(bench_);
    } else {
        drawPicture(bench_);
    }
    ImGui::EndChild();
    if (panels.isChartOpen) {
        splitter("##chart_edge", false, middle, panels.chartHeight, -1.0f, bench_);
        ImGui::BeginChild("chart", {middle, chart - bar});
        drawTimeChart(bench_);
        ImGui::EndChild();
    }
    ImGui::BeginChild("status", {middle, status});
    drawStatusBar();
    ImGui::EndChild();
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
