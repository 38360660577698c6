// SPDX-License-Identifier: MIT
#include "framework/gui/panels/error_time_plot.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <optional>

#include "framework/gui/point_heap.h"
#include "framework/gui/shown_image.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

const ImU32 kFrontColor = IM_COL32(255, 190, 64, 255);
const ImU32 kOtherColor = IM_COL32(130, 160, 200, 255);

// An axis that has room for all values: logarithmic where they are far apart.
struct Axis {
    Scale scale = Scale::linear;
    double low = 0.0;
    double high = 1.0;
    [[nodiscard]] float place(double value) const {
        return static_cast<float>(std::clamp(placeOn(scale, low, high, value), 0.0, 1.0));
    }
};

Axis axisOf(const std::vector<PlottedSetting>& points, double TimeAndError::*value) {
    double low = points.front().at.*value;
    double high = low;
    for (const PlottedSetting& point : points) {
        low = std::min(low, point.at.*value);
        high = std::max(high, point.at.*value);
    }
    // So far that there are at least two decades to write on the axis.
    constexpr double kFarApart = 60.0;
    if (low > 0.0 && high > kFarApart * low) return {Scale::logarithmic, low / 1.4, high * 1.4};
    const double room = std::max(0.15 * (high - low), 0.05 * std::max(std::abs(high), 1e-12));
    return {Scale::linear, std::max(low - room, 0.0), high + room};
}

struct PlotArea {
    ImVec2 low;
    ImVec2 high;
    Axis time;
    Axis error;
    [[nodiscard]] ImVec2 place(const TimeAndError& at) const {
        return {low.x + time.place(at.milliseconds) * (high.x - low.x),
                high.y - error.place(at.error) * (high.y - low.y)};
    }
};

void drawAxes(const PlotArea& area, const ErrorMeasure& measure) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 grid = IM_COL32(60, 60, 68, 255);
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    const float line = ImGui::GetTextLineHeight();
    draw.AddRectFilled(area.low, area.high, IM_COL32(16, 16, 20, 255));
    float free = -FLT_MAX;
    for (const ColorBar::Tick& tick : ticksOn(area.time.scale, area.time.low, area.time.high)) {
        const float x = area.low.x + static_cast<float>(tick.place) * (area.high.x - area.low.x);
        draw.AddLine({x, area.low.y}, {x, area.high.y}, grid);
        const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
        if (x - 0.5f * width < free) continue;
        draw.AddText({x - 0.5f * width, area.high.y + 2.0f}, text, tick.label.c_str());
        free = x + 0.5f * width + 6.0f;
    }
    for (const ColorBar::Tick& tick : ticksOn(area.error.scale, area.error.low, area.error.high)) {
        const float y = area.high.y - static_cast<float>(tick.place) * (area.high.y - area.low.y);
        draw.AddLine({area.low.x, y}, {area.high.x, y}, grid);
        const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
        draw.AddText({area.low.x - width - 4.0f, y - 0.5f * line}, text, tick.label.c_str());
    }
    const std::string below = "frame, ms";
    draw.AddText({area.high.x - ImGui::CalcTextSize(below.c_str()).x, area.high.y + line + 2.0f},
                 ImGui::GetColorU32(ImGuiCol_Text), below.c_str());
    const std::string above =
        std::string(measure.label) + (*measure.unit != '\0' ? ", " : "") + measure.unit;
    draw.AddText({area.low.x, area.low.y - line - 2.0f}, ImGui::GetColorU32(ImGuiCol_Text),
                 above.c_str());
}

// Steps: what lies above and to the right of the line is beaten.
void drawFront(const Bench& bench, const std::vector<PlottedSetting>& points,
               const std::vector<std::size_t>& front, const PlotArea& area) {
    std::vector<ImVec2> line;
    for (const std::size_t index : front) {
        const ImVec2 place = area.place(points[index].at);
        line.push_back({place.x, line.empty() ? area.low.y : line.back().y});
        line.push_back(place);
    }
    line.push_back({area.high.x, line.back().y});
    ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()), kFrontColor,
                                            0, 1.5f * bench.scale);
}

std::string valuesOf(const PlottedSetting& point, const ErrorMeasure& measure) {
    return fmt::format("{:.4g} ms, {} {:.4g}{}{}", point.at.milliseconds, measure.label,
                       point.at.error, *measure.unit != '\0' ? " " : "", measure.unit);
}

std::string wordsOf(const PlottedSetting& point, const ErrorMeasure& measure) {
    return fmt::format(
        "{}\n{}\n{}{}\nA click brings it back.", point.settings, valuesOf(point, measure),
        point.isOnFront ? "No other one is both faster and better.\n" : "", point.remark);
}

// `radius`, px.
PointHeap heapUnderMouse(const std::vector<PlottedSetting>& points, const PlotArea& area,
                         float radius) {
    std::vector<PointOnChart> onChart;
    for (const PlottedSetting& point : points) {
        const ImVec2 place = area.place(point.at);
        onChart.push_back({place.x, place.y, point.isNow});
    }
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    return heapAt(onChart, mouse.x, mouse.y, radius);
}

std::string wordsOf(const PointHeap& heap, const std::vector<PlottedSetting>& points,
                    const ErrorMeasure& measure) {
    const PlottedSetting& next = points[heap.points[heap.next]];
    if (heap.points.size() == 1) return wordsOf(next, measure);
    std::string text = fmt::format("{} lie here; each click brings the next one back, now {}.",
                                   heap.points.size(), next.label);
    for (const std::size_t index : heap.points) {
        const PlottedSetting& point = points[index];
        text += fmt::format("\n\n{}{}: {}\n{}", &point == &next ? "→ " : "", point.label,
                            valuesOf(point, measure), point.settings);
    }
    return text;
}

}  // namespace

const ErrorMeasure& chooseMeasure(Bench& bench, const std::string& panel) {
    std::vector<std::string> names;
    for (const ErrorMeasure& measure : kErrorMeasures)
        names.emplace_back(measure.label);
    int& chosen = bench.panels.tradeOffMeasure;
    constexpr const char* kLabel = "of caustic irradiance";
    ImGui::SetNextItemWidth(std::min(widthBeside(kLabel), static_cast<float>(bench.px(140.0))));
    static_cast<void>(choose(bench, kLabel, names, chosen, panel + ".measure"));
    return kErrorMeasures[static_cast<std::size_t>(chosen)];
}

std::vector<std::size_t> markFront(std::vector<PlottedSetting>& points) {
    std::vector<TimeAndError> values;
    for (const PlottedSetting& point : points)
        values.push_back(point.at);
    const std::vector<std::size_t> front = paretoFront(values);
    for (const std::size_t index : front)
        points[index].isOnFront = true;
    return front;
}

std::optional<std::size_t> drawErrorTimePlot(Bench& bench, const std::string& panel,
                                             const std::vector<PlottedSetting>& points,
                                             const std::vector<std::size_t>& front,
                                             const ErrorMeasure& measure) {
    std::optional<std::size_t> clicked;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = std::min(0.75f * width, static_cast<float>(bench.px(320.0)));
    const float line = ImGui::GetTextLineHeight();
    const float left = ImGui::CalcTextSize("0.00025").x + 6.0f;
    const PlotArea area{{corner.x + left, corner.y + line + 4.0f},
                        {corner.x + width - static_cast<float>(bench.px(8.0)),
                         corner.y + height - 2.0f * line - 4.0f},
                        axisOf(points, &TimeAndError::milliseconds),
                        axisOf(points, &TimeAndError::error)};
    if (area.high.x - area.low.x < 40.0f) return clicked;
    drawAxes(area, measure);
    drawFront(bench, points, front, area);
    bench.map.area(panel + ".plot", area.low.x, area.low.y, area.high.x - area.low.x,
                   area.high.y - area.low.y, fmt::format("{} points", points.size()));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const auto radius = static_cast<float>(bench.px(4.0));
    ImGui::SetCursorScreenPos({area.low.x - radius, area.low.y - radius});
    const bool isClicked = ImGui::InvisibleButton(
        (panel + ".plot").c_str(),
        {area.high.x - area.low.x + 2.0f * radius, area.high.y - area.low.y + 2.0f * radius});
    PointHeap heap;
    if (ImGui::IsItemHovered()) heap = heapUnderMouse(points, area, 2.0f * radius);
    if (!heap.points.empty()) {
        const std::string words = wordsOf(heap, points, measure);
        tooltip(words);
        bench.map.area(panel + ".heap", area.low.x, area.low.y, 1.0f, 1.0f, words);
        if (isClicked) clicked = heap.points[heap.next];
    }
    for (const PlottedSetting& point : points) {
        const ImVec2 place = area.place(point.at);
        bench.map.area(fmt::format("{}.point.{}", panel, point.label), place.x - radius,
                       place.y - radius, 2.0f * radius, 2.0f * radius,
                       point.isOnFront ? "front" : "behind");
        const ImU32 color = point.isOnFront ? kFrontColor : kOtherColor;
        draw.AddCircleFilled(place, radius, color);
        if (point.isNow) {
            draw.AddCircle(place, 1.8f * radius, IM_COL32(255, 255, 255, 255), 0,
                           1.5f * bench.scale);
        }
        draw.AddText({place.x + radius + 2.0f, place.y - line},
                     ImGui::GetColorU32(ImGuiCol_TextDisabled), point.label.c_str());
    }
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy({width, height});
    return clicked;
}

std::optional<std::size_t> drawErrorTimeRows(Bench& bench, const std::string& panel,
                                             const std::vector<PlottedSetting>& points,
                                             const ErrorMeasure& measure) {
    std::optional<std::size_t> clicked;
    Table table{{"point", "settings", "frame, ms", measure.label, "front"}, {}};
    for (const PlottedSetting& point : points) {
        table.rows.push_back(
            {point.label, point.settings, fmt::format("{:.4g}", point.at.milliseconds),
             fmt::format("{:.4g}", point.at.error), point.isOnFront ? "yes" : "no"});
    }
    drawTableButtons(bench, panel + "_points", table);
    if (!ImGui::BeginTable("points", 4, ImGuiTableFlags_RowBg)) return clicked;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("000").x);
    ImGui::TableSetupColumn("settings", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize("00000.0").x);
    ImGui::TableSetupColumn(measure.label, ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize("0.000000").x);
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const PlottedSetting& point = points[i];
        const std::vector<std::string>& cells = table.rows[i];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (ImGui::Selectable(cells[0].c_str(), point.isNow, ImGuiSelectableFlags_SpanAllColumns))
            clicked = i;
        bench.map.control(panel + ".row." + cells[0], cells[1]);
        tooltip(wordsOf(point, measure));
        for (std::size_t c = 1; c < 4; ++c) {
            ImGui::TableNextColumn();
            ImGui::PushStyleColor(
                ImGuiCol_Text, point.isOnFront ? kFrontColor : ImGui::GetColorU32(ImGuiCol_Text));
            ImGui::TextWrapped("%s", cells[c].c_str());
            ImGui::PopStyleColor();
        }
    }
    ImGui::EndTable();
    return clicked;
}

}  // namespace kaustik::gui
