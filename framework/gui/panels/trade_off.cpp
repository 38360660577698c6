// SPDX-License-Identifier: MIT
// Error against time of the settings that this session has rendered and judged: a point each, and
// the front of those that no other one beats in both.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <string>
#include <vector>

#include "framework/gui/kept_variant.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/shown_image.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

struct ErrorMeasure {
    const char* label;
    const char* key;
    const char* unit;
};
// Those of which less is better.
constexpr std::array<ErrorMeasure, 6> kErrorMeasures = {{{"relMSE", "rel_mse", ""},
                                                         {"RMSE", "rmse", "W/m²"},
                                                         {"SMAPE", "smape", ""},
                                                         {"MAE", "mae", "W/m²"},
                                                         {"FLIP", "flip_ldr", ""},
                                                         {"HDR-FLIP", "flip_hdr", ""}}};

const ImU32 kFrontColor = IM_COL32(255, 190, 64, 255);
const ImU32 kOtherColor = IM_COL32(130, 160, 200, 255);

struct Plotted {
    std::size_t point = 0;  // among the session's
    TimeAndError at;
    bool isOnFront = false;
    bool isNow = false;  // it has the settings of the variant at hand
};

struct Plot {
    std::vector<Plotted> points;     // in the order in which they were rendered
    std::vector<std::size_t> front;  // of these, by rising time
    std::size_t others = 0;          // that cannot stand next to them
};

// Of all points those that are comparable with the newest one of the document at hand.
Plot plotOf(const Bench& bench, const ErrorMeasure& measure) {
    const auto isHere = [&](const SettledPoint& point) {
        const Document& document = point.document;
        return document.scene == bench.document.scene && document.edits == bench.document.edits &&
               document.size == bench.document.size;
    };
    const auto newest = std::find_if(bench.points.rbegin(), bench.points.rend(), isHere);
    Plot plot;
    std::vector<TimeAndError> values;
    for (std::size_t i = 0; i < bench.points.size(); ++i) {
        const SettledPoint& point = bench.points[i];
        const std::optional<double> error = point.error(measure.key);
        if (newest == bench.points.rend() || !error || !areComparable(point, *newest)) {
            ++plot.others;
            continue;
        }
        const bool isNow = point.document.variant == bench.variantOf(bench.editedIndex());
        values.push_back({point.frameMs, *error});
        plot.points.push_back({i, values.back(), false, isNow});
    }
    plot.front = paretoFront(values);
    for (const std::size_t index : plot.front)
        plot.points[index].isOnFront = true;
    return plot;
}

// An axis that has room for all values: logarithmic where they are far apart.
struct Axis {
    Scale scale = Scale::linear;
    double low = 0.0;
    double high = 1.0;
    [[nodiscard]] float place(double value) const {
        return static_cast<float>(std::clamp(placeOn(scale, low, high, value), 0.0, 1.0));
    }
};

Axis axisOf(const std::vector<Plotted>& points, double TimeAndError::*value) {
    double low = points.front().at.*value;
    double high = low;
    for (const Plotted& point : points) {
        low = std::min(low, point.at.*value);
        high = std::max(high, point.at.*value);
    }
    // So far that there are at least two decades to write on the axis.
    constexpr double kFarApart = 60.0;
    if (low > 0.0 && high > kFarApart * low) return {Scale::logarithmic, low / 1.4, high * 1.4};
    const double room = std::max(0.15 * (high - low), 0.05 * std::max(std::abs(high), 1e-12));
    return {Scale::linear, std::max(low - room, 0.0), high + room};
}

// Brings its settings back; what else the document has is the same already.
void bringBack(Bench& bench, const SettledPoint& point) {
    bench.edited() = point.document.variant;
    bench.view.flipped = -1;
}

std::string wordsOf(const SettledPoint& point, const Plotted& plotted,
                    const ErrorMeasure& measure) {
    return fmt::format("{}\n{:.4g} ms, {} {:.4g}{}{}\n{}{}\nA click brings it back.",
                       settingsText(point.document.variant), plotted.at.milliseconds, measure.label,
                       plotted.at.error, *measure.unit != '\0' ? " " : "", measure.unit,
                       plotted.isOnFront ? "No other one is both faster and better.\n" : "",
                       "By a reference of " + point.reference + ".");
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
void drawFront(const Bench& bench, const Plot& plot, const PlotArea& area) {
    std::vector<ImVec2> line;
    for (const std::size_t index : plot.front) {
        const ImVec2 place = area.place(plot.points[index].at);
        line.push_back({place.x, line.empty() ? area.low.y : line.back().y});
        line.push_back(place);
    }
    line.push_back({area.high.x, line.back().y});
    ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()), kFrontColor,
                                            0, 1.5f * bench.scale);
}

void drawPlot(Bench& bench, const Plot& plot, const ErrorMeasure& measure) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = std::min(0.75f * width, static_cast<float>(bench.px(320.0)));
    const float line = ImGui::GetTextLineHeight();
    const float left = ImGui::CalcTextSize("0.00025").x + 6.0f;
    const PlotArea area{{corner.x + left, corner.y + line + 4.0f},
                        {corner.x + width - static_cast<float>(bench.px(8.0)),
                         corner.y + height - 2.0f * line - 4.0f},
                        axisOf(plot.points, &TimeAndError::milliseconds),
                        axisOf(plot.points, &TimeAndError::error)};
    if (area.high.x - area.low.x < 40.0f) return;
    drawAxes(area, measure);
    drawFront(bench, plot, area);
    bench.map.area("trade_off.plot", area.low.x, area.low.y, area.high.x - area.low.x,
                   area.high.y - area.low.y, fmt::format("{} points", plot.points.size()));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const auto radius = static_cast<float>(bench.px(4.0));
    for (std::size_t i = 0; i < plot.points.size(); ++i) {
        const Plotted& plotted = plot.points[i];
        const ImVec2 place = area.place(plotted.at);
        ImGui::SetCursorScreenPos({place.x - 2.0f * radius, place.y - 2.0f * radius});
        const std::string name = fmt::format("trade_off.point.{}", i + 1);
        if (ImGui::InvisibleButton(name.c_str(), {4.0f * radius, 4.0f * radius}))
            bringBack(bench, bench.points[plotted.point]);
        bench.map.control(name, plotted.isOnFront ? "front" : "behind");
        tooltip(wordsOf(bench.points[plotted.point], plotted, measure));
        const ImU32 color = plotted.isOnFront ? kFrontColor : kOtherColor;
        draw.AddCircleFilled(place, radius, color);
        if (plotted.isNow) {
            draw.AddCircle(place, 1.8f * radius, IM_COL32(255, 255, 255, 255), 0,
                           1.5f * bench.scale);
        }
        draw.AddText({place.x + radius + 2.0f, place.y - line},
                     ImGui::GetColorU32(ImGuiCol_TextDisabled), fmt::format("{}", i + 1).c_str());
    }
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy({width, height});
}

Table tableOf(const Bench& bench, const Plot& plot, const ErrorMeasure& measure) {
    Table table{{"point", "settings", "frame, ms", measure.label, "front"}, {}};
    for (std::size_t i = 0; i < plot.points.size(); ++i) {
        const Plotted& plotted = plot.points[i];
        table.rows.push_back(
            {fmt::format("{}", i + 1), settingsText(bench.points[plotted.point].document.variant),
             fmt::format("{:.4g}", plotted.at.milliseconds),
             fmt::format("{:.4g}", plotted.at.error), plotted.isOnFront ? "yes" : "no"});
    }
    return table;
}

void drawRows(Bench& bench, const Plot& plot, const Table& table, const ErrorMeasure& measure) {
    if (!ImGui::BeginTable("points", 4, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("000").x);
    ImGui::TableSetupColumn("settings", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize("00000.0").x);
    ImGui::TableSetupColumn(measure.label, ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize("0.000000").x);
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < plot.points.size(); ++i) {
        const Plotted& plotted = plot.points[i];
        const std::vector<std::string>& cells = table.rows[i];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (ImGui::Selectable(cells[0].c_str(), plotted.isNow,
                              ImGuiSelectableFlags_SpanAllColumns)) {
            bringBack(bench, bench.points[plotted.point]);
        }
        bench.map.control("trade_off.row." + cells[0], cells[1]);
        tooltip(wordsOf(bench.points[plotted.point], plotted, measure));
        for (std::size_t c = 1; c < 4; ++c) {
            ImGui::TableNextColumn();
            ImGui::PushStyleColor(
                ImGuiCol_Text, plotted.isOnFront ? kFrontColor : ImGui::GetColorU32(ImGuiCol_Text));
            ImGui::TextWrapped("%s", cells[c].c_str());
            ImGui::PopStyleColor();
        }
    }
    ImGui::EndTable();
}

void remark(Bench& bench, const std::string& text) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("%s", text.c_str());
    ImGui::PopTextWrapPos();
    bench.map.control("trade_off.remark", text);
}

}  // namespace

void drawTradeOff(Bench& bench) {
    chooseVariant(bench, "trade_off");
    std::vector<std::string> names;
    for (const ErrorMeasure& measure : kErrorMeasures)
        names.emplace_back(measure.label);
    int& chosen = bench.panels.tradeOffMeasure;
    ImGui::SetNextItemWidth(static_cast<float>(bench.px(140.0)));
    static_cast<void>(choose(bench, "of caustic irradiance", names, chosen, "trade_off.measure"));
    const ErrorMeasure& measure = kErrorMeasures[static_cast<std::size_t>(chosen)];
    const Plot plot = plotOf(bench, measure);
    if (plot.points.empty()) {
        remark(bench, bench.reference->photons > 0
                          ? "A point follows once these settings have settled and been judged."
                          : "Points need a reference of this view; the panel Error computes one.");
        return;
    }
    drawPlot(bench, plot, measure);
    const Table table = tableOf(bench, plot, measure);
    drawTableButtons(bench, "points", table);
    drawRows(bench, plot, table, measure);
    if (plot.others > 0) {
        remark(bench, fmt::format(
                          "{} more of this session {} of another view, reference or way of timing, "
                          "or without this measure.",
                          plot.others, plot.others == 1 ? "is" : "are"));
    }
}

}  // namespace kaustik::gui
