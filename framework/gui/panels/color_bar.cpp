// SPDX-License-Identifier: MIT
#include "framework/gui/panels/color_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

namespace kaustik::gui {
namespace {

// Of the interface's font.
constexpr float kLabelSize = 0.87f;

float labelHeight() {
    return kLabelSize * ImGui::GetFontSize();
}

ImVec2 labelSize(const std::string& label) {
    return ImGui::GetFont()->CalcTextSizeA(labelHeight(), FLT_MAX, 0.0f, label.c_str());
}

// Black or white, whichever is seen better on a display-encoded colour.
ImU32 inkOn(const std::array<float, 3>& color) {
    const float luma = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
    return luma > 0.5f ? IM_COL32(0, 0, 0, 255) : IM_COL32(255, 255, 255, 255);
}

void drawColors(const ColorBar& bar, ImVec2 low, ImVec2 high) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    constexpr int kSteps = 64;
    const float height = high.y - low.y;
    for (int i = 0; i < kSteps; ++i) {
        const std::array<float, 3> color = bar.colorAt((i + 0.5) / kSteps);
        const float y1 = low.y + height * (1.0f - static_cast<float>(i + 1) / kSteps);
        const float y2 = low.y + height * (1.0f - static_cast<float>(i) / kSteps);
        draw.AddRectFilled({low.x, y1}, {high.x, y2},
                           ImGui::GetColorU32({color[0], color[1], color[2], 1.0f}));
    }
    draw.AddRect(low, high, IM_COL32(255, 255, 255, 160));
}

// Ends beyond which there are values: they have the colours of these.
void drawClippedEnds(const ColorBar& bar, ImVec2 low, ImVec2 high, float size) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 mark = IM_COL32(255, 120, 100, 255);
    const float middle = 0.5f * (low.x + high.x);
    const float top = low.y - 2.0f;
    const float end = high.y + 2.0f;
    if (bar.clipsHigh)
        draw.AddTriangleFilled({low.x, top}, {high.x, top}, {middle, top - size}, mark);
    if (bar.clipsLow)
        draw.AddTriangleFilled({low.x, end}, {high.x, end}, {middle, end + size}, mark);
}

// `mark`: how far right of the colours a number's place is marked; on them or to their left, before
// the number, it would be taken for a minus.
void drawTicks(const ColorBar& bar, ImVec2 low, ImVec2 high, float mark) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    float free = FLT_MAX;  // above the last number
    for (const ColorBar::Tick& tick : bar.ticks) {
        const float y = high.y - (high.y - low.y) * static_cast<float>(tick.place);
        const ImU32 ink = inkOn(bar.colorAt(tick.place));
        draw.AddLine({high.x, y}, {high.x + mark, y}, IM_COL32(255, 255, 255, 255));
        const ImVec2 size = labelSize(tick.label);
        // At an end it stands within it.
        const float top = std::clamp(y - 0.5f * size.y, low.y, high.y - size.y);
        if (top + size.y > free) continue;
        draw.AddText(ImGui::GetFont(), labelHeight(), {0.5f * (low.x + high.x - size.x), top}, ink,
                     tick.label.c_str());
        free = top;
    }
}

}  // namespace

float barWidth(const Bench& bench, const ShownImage& image) {
    const std::optional<ColorBar> bar = image.colorBar();
    if (!bar) return 0.0f;
    auto widest = static_cast<float>(bench.px(14.0));
    for (const ColorBar::Tick& tick : bar->ticks)
        widest = std::max(widest, labelSize(tick.label).x);
    return widest + static_cast<float>(bench.px(6.0));
}

std::string barUnit(const ShownImage& image) {
    const std::optional<ColorBar> bar = image.colorBar();
    if (!bar) return "";
    const std::string& unit = image.content.unit();
    if (bar->power == 0) return unit.empty() ? "1" : unit;
    return powerText(bar->power) + (unit.empty() ? "" : " " + unit);
}

void drawColorBar(const Bench& bench, const ShownImage& image, ImVec2 corner, float height,
                  const std::string& name) {
    const std::optional<ColorBar> bar = image.colorBar();
    if (!bar) return;
    // Room for what marks values beyond the ends.
    const auto edge = static_cast<float>(bench.px(9.0));
    const auto gap = static_cast<float>(bench.px(3.0));
    const ImVec2 low(corner.x + 1.0f, corner.y + edge);
    const ImVec2 high(corner.x + barWidth(bench, image) - gap, corner.y + height - edge);
    if (high.y - low.y < 3.0f * ImGui::GetTextLineHeight()) return;
    drawColors(*bar, low, high);
    drawClippedEnds(*bar, low, high, edge - gap);
    drawTicks(*bar, low, high, gap);
    std::string numbers;
    for (const ColorBar::Tick& tick : bar->ticks)
        numbers += " " + tick.label;
    bench.map.area(
        name, low.x, low.y, high.x - low.x, high.y - low.y,
        fmt::format("{:.6g} {:.6g} {}{}{}", bar->low, bar->high, bar->label,
                    bar->clipsLow ? " clips low" : "", bar->clipsHigh ? " clips high" : ""));
    bench.map.area(name + ".numbers", low.x, low.y, high.x - low.x, high.y - low.y,
                   barUnit(image) + ":" + numbers);
}

}  // namespace kaustik::gui
