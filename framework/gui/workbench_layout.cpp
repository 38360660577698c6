// SPDX-License-Identifier: MIT
// Where everything stands in the workbench's window: toolbar, panels left and right, the picture
// with the time chart below it, status bar.
#include <fmt/format.h>

#include <algorithm>
#include <cfloat>

#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"
#include "framework/gui/workbench.h"

namespace kaustik::gui {

void Workbench::drawToolbar() {
    if (button(bench_, bench_.isPlaying ? "Pause" : " Play ", "toolbar.play"))
        bench_.isPlaying = !bench_.isPlaying;
    ImGui::SameLine();
    if (button(bench_, "Undo", "toolbar.undo")) undo(-1);
    ImGui::SameLine();
    if (button(bench_, "Redo", "toolbar.redo")) undo(1);
    ImGui::SameLine();
    if (button(bench_, "Whole picture", "toolbar.fit")) bench_.view.zoom = 0.0f;
    ImGui::SameLine();
    if (button(bench_, "1:1", "toolbar.one_to_one")) {
        bench_.view.zoom = 1.0f;
        bench_.view.middle = glm::vec2(0.5f);
    }
    ImGui::SameLine();
    if (button(bench_, "Keys (F1)", "toolbar.keys")) bench_.showsHelp = !bench_.showsHelp;
    ImGui::SameLine();
    const RenderWorker::Progress progress = renderer_->progress();
    if (progress.isBusy) {
        const std::string text = fmt::format("{}  {:.1f} s", progress.what, progress.seconds);
        ImGui::ProgressBar(static_cast<float>(progress.share.value_or(0.0)), {-FLT_MIN, 0.0f},
                           text.c_str());
        bench_.map.control("toolbar.progress",
                           progress.share ? fmt::format("{}", *progress.share) : "");
    } else {
        ImGui::TextDisabled("%s", bench_.result->device.renderer.c_str());
    }
}

void Workbench::drawStatusBar() {
    if (bench_.isMessageBad) {
        ImGui::TextColored({1.0f, 0.45f, 0.4f, 1.0f}, "%s", bench_.message.c_str());
    } else {
        ImGui::TextUnformatted(bench_.message.c_str());
    }
    bench_.map.control("status.message", bench_.message);
}

void Workbench::draw() {
    useKeys();
    const ImGuiViewport* viewport = ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport->WorkPos);
    ImGui::SetNextWindowSize(viewport->WorkSize);
    constexpr ImGuiWindowFlags kWhole =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
        ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse;
    ImGui::Begin("workbench", nullptr, kWhole);
    drawToolbar();
    drawShown(bench_);
    const float statusHeight = ImGui::GetTextLineHeightWithSpacing() + 4.0f;
    const ImVec2 all = ImGui::GetContentRegionAvail();
    const float height = std::max(all.y - statusHeight, 60.0f);
    PanelState& panels = bench_.panels;
    // Whatever the window's size, the picture keeps a part of it.
    const float side = std::max(0.4f * all.x, 60.0f);
    // What the user chose stays, for a larger window.
    panels.leftWidth = std::max(panels.leftWidth, 150.0f);
    panels.rightWidth = std::max(panels.rightWidth, 150.0f);
    panels.chartHeight = std::max(panels.chartHeight, 30.0f);
    const float left = std::min(panels.leftWidth * bench_.scale, side);
    const float right = std::min(panels.rightWidth * bench_.scale, side);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.0f});

    struct Tab {
        const char* name;
        void (*draw)(Bench&);
    };
    const auto tabs = [&](const char* name, float width, std::initializer_list<Tab> list) {
        ImGui::BeginChild(name, {width, height}, true);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                            ImVec2(6.0f * bench_.scale, 4.0f * bench_.scale));
        if (ImGui::BeginTabBar(name)) {
            for (const Tab& tab : list) {
                const bool isOpen = ImGui::BeginTabItem(tab.name);
                bench_.map.control(std::string("tab.") + tab.name, isOpen ? "open" : "");
                if (!isOpen) continue;
                ImGui::BeginChild(tab.name);
                tab.draw(bench_);
                ImGui::EndChild();
                ImGui::EndTabItem();
            }
            ImGui::EndTabBar();
        }
        ImGui::PopStyleVar();
        ImGui::EndChild();
    };
    tabs("left", left,
         {{"Passes", drawPasses}, {"Technique", drawTechnique}, {"Scene", drawScene}});
    ImGui::SameLine();
    splitter("##left_edge", true, height, panels.leftWidth, 1.0f, bench_);
    ImGui::SameLine();
    ImGui::BeginGroup();
    const float bars = 2.0f * static_cast<float>(bench_.px(5.0));
    const float middle = std::max(all.x - left - right - bars, 40.0f);
    const float chart = std::min(panels.chartHeight * bench_.scale, 0.6f * height);
    ImGui::BeginChild("middle", {middle, std::max(height - chart - 0.5f * bars, 30.0f)});
    drawPicture(bench_);
    ImGui::EndChild();
    splitter("##chart_edge", false, middle, panels.chartHeight, -1.0f, bench_);
    ImGui::BeginChild("chart", {middle, chart});
    drawTimeChart(bench_);
    ImGui::EndChild();
    ImGui::EndGroup();
    ImGui::SameLine();
    splitter("##right_edge", true, height, panels.rightWidth, -1.0f, bench_);
    ImGui::SameLine();
    tabs("right", 0.0f,
         {{"Parameters", drawParameters},
          {"Image", drawImage},
          {"Error", drawError},
          {"Record", drawRecord}});
    ImGui::PopStyleVar();
    drawStatusBar();
    ImGui::End();
    if (bench_.showsHelp) drawHelp(bench_);
}

}  // namespace kaustik::gui
