// SPDX-License-Identifier: MIT
// The newest frames as stacks of their passes, with an axis, a legend, and a mark where settings
// have changed.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "framework/gui/panels/panels.h"
#include "framework/gui/shown_image.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

constexpr std::size_t kFramesShown = 64;
// Frames that take longer, by this factor, reach beyond the chart.
constexpr double kMaxMedianRatio = 3.0;
// Passes that a mark's tooltip has.
constexpr std::size_t kPassesTold = 12;

// A frame of the session's runs.
struct Frame {
    std::size_t run = 0;
    std::size_t frame = 0;  // of the run
};

// The newest, oldest first.
std::vector<Frame> framesOf(const std::vector<TimedRun>& runs) {
    std::vector<Frame> frames;
    for (std::size_t run = runs.size(); run-- > 0;) {
        for (std::size_t frame = runs[run].frameMs.size(); frame-- > 0;) {
            if (frames.size() == kFramesShown) break;
            frames.push_back({run, frame});
        }
    }
    std::reverse(frames.begin(), frames.end());
    return frames;
}

// What the chart's height stands for, ms.
double heightOf(const std::vector<TimedRun>& runs, const std::vector<Frame>& frames) {
    std::vector<double> shown;
    for (const Frame& at : frames)
        shown.push_back(runs[at.run].frameMs[at.frame]);
    const double maximum = std::max(*std::max_element(shown.begin(), shown.end()), 1e-6);
    double median = 0.0;
    for (const TimedRun& run : runs)
        median = std::max(median, settledMedianOf(run.frameMs));
    // A frame that compiles takes many times as long, and would leave the others no height.
    return median > 0.0 ? std::min(maximum, kMaxMedianRatio * median) : maximum;
}

void drawAxis(Bench& bench, ImVec2 low, ImVec2 high, double maximum) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float line = ImGui::GetTextLineHeight();
    float free = high.y + line;
    std::string words;
    for (const ColorBar::Tick& tick : ticksOn(Scale::linear, 0.0, maximum)) {
        const float y = high.y - static_cast<float>(tick.place) * (high.y - low.y);
        draw.AddLine({low.x, y}, {high.x, y}, IM_COL32(60, 60, 68, 255));
        // No label over another, nor over the axis' name.
        if (y + 0.5f * line > free || y - 0.5f * line < low.y - 1.0f) continue;
        const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
        draw.AddText({low.x - width - 4.0f, y - 0.5f * line},
                     ImGui::GetColorU32(ImGuiCol_TextDisabled), tick.label.c_str());
        free = y - 0.5f * line;
        words += tick.label + " ";
    }
    bench.map.area("chart.axis", low.x, low.y, 1.0f, high.y - low.y, words + "ms");
}

// Stages of the newest run with what they take, from the top down as they are stacked.
void drawLegend(Bench& bench, const TimedRun& run, ImVec2 corner, ImVec2 size) {
    std::vector<std::pair<std::string, double>> stages;
    for (const report::PassTimes& pass : run.times) {
        if (pass.gpuMilliseconds.empty()) continue;
        const std::string stage = stageOf(pass.name);
        const auto found = std::find_if(stages.begin(), stages.end(),
                                        [&](const auto& one) { return one.first == stage; });
        const double median = settledMedianOf(pass.gpuMilliseconds);
        if (found != stages.end()) {
            found->second += median;
        } else {
            stages.emplace_back(stage, median);
        }
    }
    const float line = ImGui::GetTextLineHeight();
    const auto rows = static_cast<std::size_t>(std::max(size.y / line, 1.0f));
    const bool isCut = stages.size() > rows;
    // The cheapest are left out where there is no room.
    if (isCut) {
        std::vector<std::pair<std::string, double>> byCost = stages;
        std::sort(byCost.begin(), byCost.end(),
                  [](const auto& a, const auto& b) { return a.second > b.second; });
        const double least = byCost[std::max<std::size_t>(rows, 2) - 2].second;
        std::erase_if(stages, [&](const auto& one) { return one.second < least; });
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    float y = corner.y;
    for (std::size_t i = stages.size(); i-- > 0;) {
        const auto& [stage, median] = stages[i];
        const float swatch = 0.6f * line;
        draw.AddRectFilled({corner.x, y + 0.2f * line},
                           {corner.x + swatch, y + 0.2f * line + swatch},
                           ImGui::GetColorU32(stageColor(bench.registry, stage)));
        draw.AddText({corner.x + line, y}, ImGui::GetColorU32(ImGuiCol_Text),
                     fmt::format("{} {:.1f}", stage, median).c_str());
        bench.map.area("chart.legend." + stage, corner.x, y, size.x, line,
                       fmt::format("{:.2f}", median));
        y += line;
    }
    if (isCut) draw.AddText({corner.x + line, y}, ImGui::GetColorU32(ImGuiCol_TextDisabled), "…");
}

// What a change has cost or saved, a line each.
std::string beforeAndAfter(const TimedRun& before, const TimedRun& after) {
    const Table table = timesBeforeAndAfter(before, after);
    std::string text = after.change + "\nms before → after, medians:";
    for (std::size_t i = 0; i < std::min(table.rows.size(), kPassesTold); ++i) {
        const std::vector<std::string>& row = table.rows[i];
        text += fmt::format("\n{}: {} → {} ({})", row[0], row[1], row[2], row[3]);
    }
    if (table.rows.size() > kPassesTold)
        text += fmt::format("\nand {} more that differ less", table.rows.size() - kPassesTold);
    return text;
}

}  // namespace

void drawTimeChart(Bench& bench) {
    const std::vector<TimedRun>& runs = bench.histories[bench.editedIndex()].runs();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::GetContentRegionAvail();
    if (size.x < 40.0f || size.y < 20.0f) return;
    ImGui::InvisibleButton("chart", size);
    const std::vector<Frame> frames = framesOf(runs);
    bench.map.control("chart", fmt::format("{}", frames.size()));
    const bool isHovered = ImGui::IsItemHovered();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(16, 16, 20, 255));
    const char* variant = !bench.document.other ? "" : bench.editedIndex() == 0 ? "A, " : "B, ";
    const std::string unit = fmt::format("{}ms a frame", variant);
    draw.AddText({corner.x + 4.0f, corner.y + 1.0f}, IM_COL32(200, 200, 200, 255), unit.c_str());
    if (frames.empty()) return;

    const double maximum = heightOf(runs, frames);
    const float line = ImGui::GetTextLineHeight();
    const float axis = ImGui::CalcTextSize("00000").x + 8.0f;
    // Where there is no room for both, bars have it.
    const auto wanted = ImGui::CalcTextSize("reconstruct 00000.0").x + line + 12.0f;
    const float legend = size.x > 3.0f * wanted ? wanted : 0.0f;
    const ImVec2 low(corner.x + axis, corner.y + line + 2.0f);
    const ImVec2 high(corner.x + size.x - legend - 4.0f, corner.y + size.y - 3.0f);
    if (high.x - low.x < 20.0f || high.y - low.y < 8.0f) return;
    drawAxis(bench, low, high, maximum);
    if (legend > 0.0f) {
        drawLegend(bench, runs.back(), {high.x + 8.0f, corner.y + 1.0f},
                   {legend - 8.0f, size.y - 2.0f});
    }
    const float width = std::min((high.x - low.x) / static_cast<float>(frames.size()),
                                 static_cast<float>(bench.px(24.0)));
    std::string pointed;
    draw.PushClipRect({low.x, corner.y}, high, true);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const TimedRun& run = runs[frames[i].run];
        const std::size_t frame = frames[i].frame;
        // The newest at the right.
        const float x = high.x - width * static_cast<float>(frames.size() - i);
        float y = high.y;
        for (const report::PassTimes& pass : run.times) {
            if (frame >= pass.gpuMilliseconds.size()) continue;
            const float height =
                static_cast<float>(pass.gpuMilliseconds[frame] / maximum) * (high.y - low.y);
            const ImVec2 top(x, std::max(y - height, low.y));
            const ImVec2 bottom(x + std::max(width - 1.0f, 1.0f), std::max(y, low.y));
            draw.AddRectFilled(top, bottom,
                               ImGui::GetColorU32(stageColor(bench.registry, stageOf(pass.name))));
            if (isHovered && mouse.x >= x && mouse.x < x + width && mouse.y >= top.y &&
                mouse.y < bottom.y) {
                pointed = fmt::format("{}: {:.2f} ms of {:.2f} ms", pass.name,
                                      pass.gpuMilliseconds[frame], run.frameMs[frame]);
            }
            y -= height;
        }
    }
    int marks = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (frames[i].run == frames[i - 1].run) continue;
        const float x = high.x - width * static_cast<float>(frames.size() - i) - 0.5f;
        const float half = 0.3f * line;
        draw.AddLine({x, low.y}, {x, high.y}, IM_COL32(255, 255, 255, 200), 1.0f * bench.scale);
        draw.AddTriangleFilled({x - half, low.y - half}, {x + half, low.y - half},
                               {x, low.y + half}, IM_COL32(255, 255, 255, 230));
        const std::string words = beforeAndAfter(runs[frames[i - 1].run], runs[frames[i].run]);
        bench.map.area(fmt::format("chart.mark.{}", ++marks), x - half, low.y - half, 2.0f * half,
                       high.y - low.y + half, words);
        const float reach =
            std::max(half, std::min(0.5f * width, static_cast<float>(bench.px(5.0))));
        if (isHovered && std::abs(mouse.x - x) <= reach) pointed = words;
    }
    draw.PopClipRect();
    if (!pointed.empty()) tooltip(pointed);
}

}  // namespace kaustik::gui
