// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

constexpr std::size_t kFramesShown = 64;
// Frames that take longer, by this factor, reach beyond the chart.
constexpr double kMaxMedianRatio = 3.0;

}  // namespace

void drawTimeChart(Bench& bench) {
    const VariantResult& result = bench.editedResult();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::GetContentRegionAvail();
    if (size.x < 40.0f || size.y < 20.0f) return;
    ImGui::InvisibleButton("chart", size);
    bench.map.control("chart", fmt::format("{}", result.frameMs.size()));
    const bool isHovered = ImGui::IsItemHovered();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(16, 16, 20, 255));
    if (result.frameMs.empty() || result.times.empty()) return;

    const std::size_t frames = result.frameMs.size();
    const std::size_t first = frames > kFramesShown ? frames - kFramesShown : 0;
    double maximum = 1e-6;
    for (std::size_t frame = first; frame < frames; ++frame)
        maximum = std::max(maximum, result.frameMs[frame]);
    // A frame that compiles takes many times as long, and would leave the others no height.
    maximum = std::min(maximum, kMaxMedianRatio * medianOf(result.frameMs));
    const float width =
        std::min(size.x / static_cast<float>(frames - first), static_cast<float>(bench.px(24.0)));
    std::string pointed;
    draw.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    for (std::size_t frame = first; frame < frames; ++frame) {
        // The newest at the right.
        const float x = corner.x + size.x - width * static_cast<float>(frames - frame);
        float y = corner.y + size.y;
        for (const report::PassTimes& pass : result.times) {
            if (frame >= pass.gpuMilliseconds.size()) continue;
            const float height =
                static_cast<float>(pass.gpuMilliseconds[frame] / maximum) * (size.y - 4.0f);
            const ImVec2 low(x, y - height);
            const ImVec2 high(x + std::max(width - 1.0f, 1.0f), y);
            draw.AddRectFilled(low, high,
                               ImGui::GetColorU32(stageColor(bench.registry, stageOf(pass.name))));
            if (isHovered && mouse.x >= x && mouse.x < x + width && mouse.y >= low.y &&
                mouse.y < high.y) {
                pointed = fmt::format("{}: {:.2f} ms of {:.2f} ms", pass.name,
                                      pass.gpuMilliseconds[frame], result.frameMs[frame]);
            }
            y -= height;
        }
    }
    draw.PopClipRect();
    const char* variant = !bench.document.other ? "" : bench.editedIndex() == 0 ? "A: " : "B: ";
    const std::string scale = fmt::format("{}{:.1f} ms", variant, maximum);
    draw.AddText({corner.x + 4.0f, corner.y + 2.0f}, IM_COL32(200, 200, 200, 255), scale.c_str());
    if (!pointed.empty()) tooltip(pointed);
}

}  // namespace kaustik::gui
