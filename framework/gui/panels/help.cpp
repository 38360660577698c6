// SPDX-License-Identifier: MIT
#include <array>
#include <utility>

#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {

void drawHelp(Bench& bench) {
    static constexpr std::array<std::pair<const char*, const char*>, 23> kKeys = {{
        {"F1", "this list"},
        {"Space", "play and pause"},
        {".", "a step of time"},
        {"drag", "orbit about the camera's target"},
        {"right drag", "look around"},
        {"W A S D, Q E", "fly, by place (Z Q S D, A E in French); with Shift four times as fast"},
        {"Ctrl + wheel", "nearer and farther"},
        {"wheel", "zoom into the picture; middle drag moves it"},
        {"0", "the whole picture"},
        {"R", "the scene's own camera"},
        {"L", "handles of the lights"},
        {"F", "false colours"},
        {"+ or =, -", "exposure"},
        {"P", "probe photons; then click on the picture"},
        {"K, then 1 to 9", "keep what is shown; flip to it and back"},
        {"F2 F3 F4", "left panel, right panel, time chart"},
        {"G", "the graph of passes in the place of the picture"},
        {"H", "the picture alone"},
        {"Ctrl + Z, Ctrl + Y", "undo and redo"},
        {"Ctrl + S", "save as experiment"},
        {"F5", "read the scene's file again"},
        {"F12", "screenshot of the window"},
        {"Ctrl + Q", "quit"},
    }};
    const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
    ImGui::SetNextWindowPos(middle, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (ImGui::Begin("Keys", &bench.showsHelp, ImGuiWindowFlags_AlwaysAutoResize)) {
        if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
            for (const auto& [key, meaning] : kKeys) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(key);
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(meaning);
            }
            ImGui::EndTable();
        }
        ImGui::TextDisabled("Others by the characters on the keys. While you type only F1 to F12.");
        bench.map.area("help", ImGui::GetWindowPos().x, ImGui::GetWindowPos().y,
                       ImGui::GetWindowWidth(), ImGui::GetWindowHeight());
    }
    ImGui::End();
}

}  // namespace kaustik::gui
