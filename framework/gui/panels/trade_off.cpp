// SPDX-License-Identifier: MIT
// Error against time of the settings that this session has rendered and judged: a point each, and
// the front of those that no other one beats in both.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "framework/gui/kept_variant.h"
#include "framework/gui/panels/error_time_plot.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

struct Plot {
    std::vector<PlottedSetting> points;  // in the order in which they were rendered
    std::vector<std::size_t> among;      // the session's, each
    std::size_t others = 0;              // that cannot stand next to them
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
    for (std::size_t i = 0; i < bench.points.size(); ++i) {
        const SettledPoint& point = bench.points[i];
        const std::optional<double> error = point.error(measure.key);
        if (newest == bench.points.rend() || !error || !areComparable(point, *newest)) {
            ++plot.others;
            continue;
        }
        const bool isNow = point.document.variant == bench.variantOf(bench.editedIndex());
        plot.points.push_back({fmt::format("{}", plot.points.size() + 1),
                               settingsText(point.document.variant),
                               "By a reference of " + point.reference + ".",
                               {point.frameMs, *error},
                               isNow});
        plot.among.push_back(i);
    }
    return plot;
}

// Brings its settings back; what else the document has is the same already.
void bringBack(Bench& bench, const SettledPoint& point) {
    bench.edited() = point.document.variant;
    bench.view.flipped = -1;
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
    const ErrorMeasure& measure = chooseMeasure(bench, "trade_off");
    Plot plot = plotOf(bench, measure);
    if (plot.points.empty()) {
        remark(bench, bench.reference->photons > 0
                          ? "A point follows once these settings have settled and been judged."
                          : "Points need a reference of this view; the panel Error computes one.");
        return;
    }
    const std::vector<std::size_t> front = markFront(plot.points);
    std::optional<std::size_t> clicked =
        drawErrorTimePlot(bench, "trade_off", plot.points, front, measure);
    if (const auto row = drawErrorTimeRows(bench, "trade_off", plot.points, measure)) clicked = row;
    if (clicked) bringBack(bench, bench.points[plot.among[*clicked]]);
    if (plot.others > 0) {
        remark(bench, fmt::format(
                          "{} more of this session {} of another view, reference or way of timing, "
                          "or without this measure.",
                          plot.others, plot.others == 1 ? "is" : "are"));
    }
}

}  // namespace kaustik::gui
