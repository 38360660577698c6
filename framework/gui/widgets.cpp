// SPDX-License-Identifier: MIT
#include "framework/gui/widgets.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/core/files.h"
#include "framework/gui/recording_name.h"
#include "framework/gui/typed_value.h"

namespace kaustik::gui {
namespace {

constexpr std::size_t kOptionsToSearch = 16;

// Its beginning, as much as there is room for with the mark that there is more.
std::string withEllipsis(const std::string& text, float room) {
    constexpr const char* kMore = "...";
    const ImFont& font = *ImGui::GetFont();
    const char* end = nullptr;
    font.CalcTextSizeA(ImGui::GetFontSize(), room - ImGui::CalcTextSize(kMore).x, 0.0f,
                       text.c_str(), nullptr, &end);
    return text.substr(0, static_cast<std::size_t>(end - text.c_str())) + kMore;
}

void showTooltip(const std::string& text) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 40.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

bool inputExtent(const char* label, params::Extent& value, int minimum, int maximum) {
    // What is typed into one side must outlive the step to the other; only one is typed at a time.
    static thread_local ImGuiID edited = 0;
    static thread_local std::array<int, 2> typed = {};
    const ImGuiID id = ImGui::GetID(label);
    std::array<int, 2> sides = {value.width, value.height};
    if (edited == id) sides = typed;
    if (ImGui::InputInt2(label, sides.data())) {
        edited = id;
        typed = sides;
    }
    if (!ImGui::IsItemDeactivated()) return false;
    const params::Extent entered{std::clamp(sides[0], minimum, maximum),
                                 std::clamp(sides[1], minimum, maximum)};
    const bool isChanged = edited == id && !(entered == value);
    if (edited == id) value = entered;
    edited = 0;
    return isChanged;
}

void sparkline(const std::vector<double>& values, ImVec2 size) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    if (values.size() < 2) return;
    // One value that is far out, as of a frame that compiles, would leave the others no height.
    const double maximum = std::max(
        std::min(*std::max_element(values.begin(), values.end()), 3.0 * medianOf(values)), 1e-9);
    std::vector<ImVec2> points;
    for (std::size_t i = 0; i < values.size(); ++i) {
        points.emplace_back(
            corner.x + size.x * static_cast<float>(i) / static_cast<float>(values.size() - 1),
            corner.y +
                size.y * (1.0f - 0.9f * static_cast<float>(std::min(values[i] / maximum, 1.0))));
    }
    ImGui::GetWindowDrawList()->AddPolyline(points.data(), static_cast<int>(points.size()),
                                            ImGui::GetColorU32(ImGuiCol_PlotLines), 0, 1.0f);
}

void splitter(const char* name, bool isVertical, float length, float& size, float sign,
              Bench& bench) {
    const auto thickness = static_cast<float>(bench.px(5.0));
    ImGui::InvisibleButton(name,
                           isVertical ? ImVec2(thickness, length) : ImVec2(length, thickness));
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(isVertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                                  ImGui::GetColorU32(ImGuiCol_SeparatorHovered));
    }
    if (ImGui::IsItemActive()) {
        const ImVec2 way = ImGui::GetIO().MouseDelta;
        size += sign * (isVertical ? way.x : way.y) / bench.scale;
    }
    bench.map.control(fmt::format("splitter.{}", name + 2));
}

void drawTableButtons(Bench& bench, const std::string& name, const Table& table) {
    ImGui::PushID(name.c_str());
    if (ImGui::SmallButton("copy")) {
        ImGui::SetClipboardText(toText(table).c_str());
        bench.notify(fmt::format("Copied {} rows.", table.rows.size()));
    }
    bench.map.control("table.copy." + name);
    tooltip("The table as text, into the clipboard.");
    ImGui::SameLine();
    if (ImGui::SmallButton("CSV")) {
        const std::filesystem::path file =
            recordFolder(bench.panels) /
            fmt::format("{}-{}.csv", recordingName(bench.document.scene), name);
        try {
            std::filesystem::create_directories(file.parent_path());
            writeFileWhole(file, toCsv(table));
            bench.notify(fmt::format("Wrote {}.", file.string()));
        } catch (const std::exception& error) {
            bench.notifyUnwritten(error.what());
        }
    }
    bench.map.control("table.csv." + name);
    tooltip("The table as a file in the folder of the panel Record.");
    ImGui::PopID();
}

void tooltip(const std::string& text) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) showTooltip(text);
}

void cutLine(const std::string& text, ImVec2 at, ImU32 color, float room) {
    const float height = ImGui::GetTextLineHeight();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const bool isCut = ImGui::CalcTextSize(text.c_str()).x > room;
    draw.PushClipRect(at, {at.x + room, at.y + height}, true);
    draw.AddText(at, color, (isCut ? withEllipsis(text, room) : text).c_str());
    draw.PopClipRect();
    if (isCut && ImGui::IsMouseHoveringRect(at, {at.x + room, at.y + height}) &&
        ImGui::IsWindowHovered())
        showTooltip(text);
}

void sameLineWithRoom(float width) {
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width <= end)
        ImGui::SameLine();
}

bool button(Bench& bench, const char* label, const std::string& name) {
    const bool isPressed = ImGui::Button(label);
    bench.map.control(name);
    return isPressed;
}

bool checkbox(Bench& bench, const char* label, bool& value, const std::string& name) {
    const bool isChanged = ImGui::Checkbox(label, &value);
    bench.map.control(name, value ? "on" : "off");
    return isChanged;
}

void inputText(Bench& bench, const char* label, const char* hint, std::string& text,
               const std::string& name) {
    ImGui::InputTextWithHint(label, hint, &text);
    bench.map.control(name, text);
}

float widthBeside(const char* label) {
    const float row = ImGui::GetContentRegionAvail().x;
    return std::max(
        row - ImGui::CalcTextSize(label).x - ImGui::GetStyle().ItemInnerSpacing.x - 1.0f,
        0.35f * row);
}

void searchField(Bench& bench, std::string& filter, const std::string& name) {
    inputText(bench, "##filter", "search", filter, name);
    // Dear ImGui takes Escape for the field alone, and would ask for another one to close the list.
    if (ImGui::IsItemDeactivated() &&
        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
        ImGui::CloseCurrentPopup();
}

bool choose(Bench& bench, const char* label, const std::vector<std::string>& options, int& index,
            const std::string& name, const char* hint) {
    const auto current = static_cast<std::size_t>(index);
    const char* shown = current < options.size() ? options[current].c_str() : hint;
    bool isChanged = false;
    const bool isOpen = ImGui::BeginCombo(label, shown, ImGuiComboFlags_HeightLargest);
    bench.map.control(name, shown);
    if (!isOpen) return false;
    // A long list is searched; only one can be open.
    static thread_local std::string filter;
    if (ImGui::IsWindowAppearing()) {
        filter.clear();
        if (options.size() > kOptionsToSearch) ImGui::SetKeyboardFocusHere();
    }
    if (options.size() > kOptionsToSearch) {
        ImGui::SetNextItemWidth(-FLT_MIN);
        searchField(bench, filter, name + ".search");
    }
    for (std::size_t i = 0; i < options.size(); ++i) {
        if (options[i].find(filter) == std::string::npos) continue;
        if (ImGui::Selectable(options[i].c_str(), i == current)) {
            isChanged = i != current;
            index = static_cast<int>(i);
        }
        bench.map.control(name + "=" + options[i]);
        if (i == current && options.size() <= kOptionsToSearch) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
    return isChanged;
}

void chooseVariant(Bench& bench, const std::string& panel) {
    if (!bench.document.other) return;
    int edited = bench.panels.edited;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("This panel is of variant");
    for (const int variant : {0, 1}) {
        ImGui::SameLine();
        const char* name = variant == 0 ? "A" : "B";
        ImGui::RadioButton(fmt::format("{}##{}", name, panel).c_str(), &edited, variant);
        bench.map.control(fmt::format("{}.edit_{}", panel, variant == 0 ? "a" : "b"),
                          edited == variant ? "on" : "off");
    }
    bench.panels.edited = edited;
    ImGui::Separator();
}

bool resetMark(Bench& bench, const std::string& name, const std::string& before) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.75f, 0.25f, 1.0f));
    const bool isUsed = ImGui::SmallButton(fmt::format("×##{}", name).c_str());
    ImGui::PopStyleColor();
    bench.map.control("reset." + name);
    tooltip(fmt::format("Changed; back to {}", before));
    return isUsed;
}

std::string stageOf(const std::string& pass) {
    return pass.substr(0, pass.find('.'));
}

std::size_t stageRank(const Registry& registry, const std::string& stage) {
    const std::vector<Registry::StageEntry>& stages = registry.stages();
    const auto found =
        std::find_if(stages.begin(), stages.end(),
                     [&](const Registry::StageEntry& other) { return other.name == stage; });
    return static_cast<std::size_t>(found - stages.begin());
}

ImVec4 stageColor(const Registry& registry, const std::string& stage) {
    // Hues a golden angle apart: neighbours in the chart differ most.
    const std::size_t place = stageRank(registry, stage);
    const float hue = std::fmod(0.61803f * static_cast<float>(place) + 0.55f, 1.0f);
    ImVec4 color(0.0f, 0.0f, 0.0f, 1.0f);
    ImGui::ColorConvertHSVtoRGB(hue, 0.55f, 0.85f, color.x, color.y, color.z);
    return color;
}

const report::PassTimes* timesOf(const VariantResult& result, const std::string& pass) {
    const auto found =
        std::find_if(result.times.begin(), result.times.end(),
                     [&](const report::PassTimes& times) { return times.name == pass; });
    return found == result.times.end() || found->gpuMilliseconds.empty() ? nullptr : &*found;
}

void showPanel(Bench& bench, const std::string& name) {
    PanelState& panels = bench.panels;
    const bool isLeft = panels.leftTabs.contains(name);
    (isLeft ? panels.leftTab : panels.rightTab) = name;
    (isLeft ? panels.isLeftOpen : panels.isRightOpen) = true;
}

}  // namespace kaustik::gui
