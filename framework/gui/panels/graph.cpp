// SPDX-License-Identifier: MIT
// The graph of passes as a picture, in the place of the one that they make: stages in columns, a
// box a pass with its time, a line for what flows from one to another.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/gui/panels/panels.h"
#include "framework/gui/pass_graph.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

using graph::PassState;

// At scale 1.
constexpr double kGap = 34.0;  // between columns, for the lines
constexpr double kRowGap = 12.0;
constexpr double kPadding = 6.0;

struct Box {
    ImVec2 low;
    ImVec2 high;
    std::string label;
    std::string time;
    double share = 0.0;  // of the frame
};

std::string nameInStage(const std::string& pass) {
    const std::size_t dot = pass.find('.');
    return dot == std::string::npos ? pass : pass.substr(dot + 1);
}

// Where every pass stands, from the corner on, as wide as its column's longest name; `size`: of
// all.
std::vector<Box> boxesOf(const Bench& bench, const VariantResult& result, const PassGraph& graph,
                         ImVec2 corner, ImVec2& size) {
    const double frameMs = settledMedianOf(result.frameMs);
    const auto padding = static_cast<float>(bench.px(kPadding));
    const float line = ImGui::GetTextLineHeight();
    std::vector<Box> boxes(graph.nodes.size());
    std::vector<float> widths(graph.columns.size());
    for (std::size_t c = 0; c < graph.columns.size(); ++c)
        widths[c] = ImGui::CalcTextSize(graph.columns[c].c_str()).x;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const graph::PassRecord& pass = result.passes[graph.nodes[i].record];
        Box& box = boxes[i];
        box.label = nameInStage(pass.name);
        if (pass.repeats > 1) box.label += fmt::format(" ×{}", pass.repeats);
        box.time = pass.state == PassState::culled     ? "culled"
                   : pass.state == PassState::bypassed ? "off"
                                                       : "";
        const report::PassTimes* times = timesOf(result, pass.name);
        if (pass.state == PassState::ran && times != nullptr) {
            const double median = settledMedianOf(times->gpuMilliseconds);
            box.time = fmt::format("{:.2f} ms", median);
            box.share = frameMs > 0.0 ? median / frameMs : 0.0;
        }
        float& width = widths[graph.nodes[i].column];
        width = std::max({width, ImGui::CalcTextSize(box.label.c_str()).x + 2.0f * padding,
                          ImGui::CalcTextSize(box.time.c_str()).x + 2.0f * padding});
    }
    std::vector<float> left(graph.columns.size());
    float x = corner.x;
    for (std::size_t c = 0; c < left.size(); ++c) {
        left[c] = x;
        x += widths[c] + static_cast<float>(bench.px(kGap));
    }
    const float height = 2.0f * line + padding;
    const float top = corner.y + line + static_cast<float>(bench.px(kRowGap));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const PassGraph::Node& node = graph.nodes[i];
        // Boxes of neighbouring columns are staggered, so that lines past them are told apart.
        const float shift = node.column % 2 == 1 ? 0.5f * height : 0.0f;
        boxes[i].low = {
            left[node.column],
            top + shift +
                static_cast<float>(node.row) * (height + static_cast<float>(bench.px(kRowGap)))};
        boxes[i].high = {boxes[i].low.x + widths[node.column], boxes[i].low.y + height};
    }
    size = {x - corner.x - static_cast<float>(bench.px(kGap)),
            top - corner.y +
                (static_cast<float>(graph.rows) + 0.5f) *
                    (height + static_cast<float>(bench.px(kRowGap)))};
    return boxes;
}

void drawEdge(const Bench& bench, const Box& from, const Box& to, ImU32 color, float thickness) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float middle = 0.5f * (from.low.y + from.high.y);
    if (to.low.x == from.low.x) {
        // Within a stage: from the lower edge to the upper one.
        const float x = from.low.x + static_cast<float>(bench.px(10.0));
        draw.AddLine({x, from.high.y}, {x, to.low.y}, color, thickness);
        return;
    }
    const ImVec2 begin(from.high.x, middle);
    const ImVec2 end(to.low.x, 0.5f * (to.low.y + to.high.y));
    const float reach =
        std::max(0.4f * std::abs(end.x - begin.x), static_cast<float>(bench.px(kGap)));
    draw.AddBezierCubic(begin, {begin.x + reach, begin.y}, {end.x - reach, end.y}, end, color,
                        thickness);
}

std::string tooltipOf(const graph::PassRecord& pass, const Box& box) {
    const auto list = [](const std::vector<std::string>& names) {
        return names.empty() ? std::string("nothing") : fmt::format("{}", fmt::join(names, ", "));
    };
    return fmt::format(
        "{}\n{}: {}\n{}reads {}\nwrites {}", pass.name, nameOf(pass.state), pass.reason,
        box.share > 0.0 ? fmt::format("{}, {:.0f} % of the frame\n", box.time, 100.0 * box.share)
                        : "",
        list(pass.reads), list(pass.writes));
}

// The boxes as buttons; gives the one that the mouse is on, or their number.
std::size_t useBoxes(Bench& bench, const VariantResult& result, const PassGraph& graph,
                     const std::vector<Box>& boxes) {
    std::size_t pointed = boxes.size();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const graph::PassRecord& pass = result.passes[graph.nodes[i].record];
        ImGui::SetCursorScreenPos(boxes[i].low);
        const ImVec2 size(boxes[i].high.x - boxes[i].low.x, boxes[i].high.y - boxes[i].low.y);
        if (ImGui::InvisibleButton(pass.name.c_str(), size)) {
            bench.view.pass = pass.name;
            showPanel(bench, "Passes");
        }
        if (ImGui::IsItemHovered()) pointed = i;
        bench.map.control("graph." + pass.name, nameOf(pass.state));
        tooltip(tooltipOf(pass, boxes[i]));
    }
    return pointed;
}

void drawBox(const Bench& bench, const graph::PassRecord& pass, const Box& box, bool isMarked) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec4 stage = stageColor(bench.registry, stageOf(pass.name));
    const bool hasRun = pass.state == PassState::ran;
    const float rounding = 3.0f * bench.scale;
    draw.AddRectFilled(box.low, box.high, IM_COL32(30, 30, 36, 255), rounding);
    if (hasRun) {
        // As much of it as the pass takes of the frame.
        const auto share = static_cast<float>(std::clamp(box.share, 0.0, 1.0));
        draw.AddRectFilled(box.low, {box.low.x + share * (box.high.x - box.low.x), box.high.y},
                           ImGui::GetColorU32(ImVec4(stage.x, stage.y, stage.z, 0.45f)), rounding);
    }
    const ImVec4 edge = pass.state == PassState::culled ? ImVec4(0.35f, 0.35f, 0.35f, 1.0f) : stage;
    draw.AddRect(box.low, box.high,
                 isMarked ? IM_COL32(255, 255, 255, 255) : ImGui::GetColorU32(edge), rounding, 0,
                 (isMarked ? 2.0f : 1.0f) * bench.scale);
    const ImU32 text = hasRun ? ImGui::GetColorU32(ImGuiCol_Text) : IM_COL32(128, 128, 128, 255);
    const auto padding = static_cast<float>(bench.px(kPadding));
    const float y = box.low.y + 0.5f * padding;
    draw.AddText({box.low.x + padding, y}, text, box.label.c_str());
    draw.AddText({box.low.x + padding, y + ImGui::GetTextLineHeight()},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), box.time.c_str());
}

}  // namespace

void drawGraph(Bench& bench) {
    const VariantResult& result = bench.editedResult();
    if (button(bench, "Back to the picture (G)", "graph.back")) bench.panels.showsGraph = false;
    ImGui::SameLine(0.0f, static_cast<float>(bench.px(8.0)));
    ImGui::AlignTextToFramePadding();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled(
        "%sa box a pass, filled by its share of the frame; grey: culled, nothing "
        "asks for it. A click shows what it reads and writes.",
        !bench.document.other      ? ""
        : bench.editedIndex() == 0 ? "Variant A: "
                                   : "Variant B: ");
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0.0f, static_cast<float>(bench.px(4.0))});
    if (result.passes.empty()) {
        ImGui::TextDisabled("The graph follows with the first whole frame.");
        return;
    }
    ImGui::BeginChild("graph", {0.0f, 0.0f}, false, ImGuiWindowFlags_HorizontalScrollbar);
    const PassGraph graph = passGraphOf(result.passes);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImVec2 size;
    const std::vector<Box> boxes = boxesOf(bench, result, graph, corner, size);
    // Lines lie behind boxes.
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.ChannelsSplit(2);
    draw.ChannelsSetCurrent(1);
    for (std::size_t c = 0; c < graph.columns.size(); ++c) {
        const auto first = std::find_if(graph.nodes.begin(), graph.nodes.end(),
                                        [&](const auto& node) { return node.column == c; });
        const Box& box = boxes[static_cast<std::size_t>(first - graph.nodes.begin())];
        draw.AddText({box.low.x, corner.y},
                     ImGui::GetColorU32(stageColor(bench.registry, graph.columns[c])),
                     graph.columns[c].c_str());
    }
    const std::size_t pointed = useBoxes(bench, result, graph, boxes);
    const auto isMarked = [&](std::size_t node) {
        return node == pointed || (pointed == boxes.size() &&
                                   result.passes[graph.nodes[node].record].name == bench.view.pass);
    };
    for (std::size_t i = 0; i < boxes.size(); ++i)
        drawBox(bench, result.passes[graph.nodes[i].record], boxes[i], isMarked(i));
    draw.ChannelsSetCurrent(0);
    const bool hasMark = [&] {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (isMarked(i)) return true;
        }
        return false;
    }();
    for (const PassGraph::Edge& edge : graph.edges) {
        const graph::PassRecord& to = result.passes[graph.nodes[edge.to].record];
        const graph::PassRecord& from = result.passes[graph.nodes[edge.from].record];
        const bool isMarkedEdge = isMarked(edge.from) || isMarked(edge.to);
        const bool isCulled = to.state == PassState::culled;
        ImVec4 color = isCulled ? ImVec4(0.4f, 0.4f, 0.4f, 1.0f)
                                : stageColor(bench.registry, stageOf(from.name));
        color.w = isMarkedEdge ? 1.0f : hasMark ? 0.15f : 0.5f;
        drawEdge(bench, boxes[edge.from], boxes[edge.to], ImGui::GetColorU32(color),
                 (isMarkedEdge ? 2.0f : 1.0f) * bench.scale);
    }
    draw.ChannelsMerge();
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy(size);
    bench.map.area("graph", corner.x, corner.y, size.x, size.y,
                   fmt::format("{} passes, {} lines, {} columns", graph.nodes.size(),
                               graph.edges.size(), graph.columns.size()));
    ImGui::EndChild();
}

}  // namespace kaustik::gui
