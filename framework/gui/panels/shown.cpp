// SPDX-License-Identifier: MIT
#include <algorithm>

#include "framework/gui/panels/panels.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

ImVec4 colorOf(Shown::Kind kind) {
    switch (kind) {
        case Shown::Kind::requested:
            return {0.45f, 0.75f, 0.45f, 1.0f};
        case Shown::Kind::rendering:
            return {0.5f, 0.7f, 1.0f, 1.0f};
        case Shown::Kind::limited:
        case Shown::Kind::preview:
            return {1.0f, 0.8f, 0.35f, 1.0f};
        case Shown::Kind::impossible:
        case Shown::Kind::stale:
            break;
    }
    return {1.0f, 0.45f, 0.4f, 1.0f};
}

int lastLayer(const Bench& bench) {
    int layers = bench.view.layer + 1;
    for (const VariantResult& variant : bench.result->variants) {
        if (variant.viewed) layers = std::min(layers, variant.viewed->layers);
    }
    return layers - 1;
}

void go(Bench& bench, Shown::Remedy remedy) {
    Document& document = bench.document;
    switch (remedy) {
        case Shown::Remedy::back:
            document = bench.whole.value_or(document);
            if (!document.other) bench.panels.edited = 0;
            break;
        case Shown::Remedy::forget:
            for (Variant* variant :
                 {&document.variant, document.other ? &*document.other : nullptr}) {
                if (variant == nullptr) continue;
                variant->assignments.clear();
                variant->disabled.clear();
            }
            break;
        case Shown::Remedy::defaultScene:
            document.scene = Document().scene;
            document.edits = {};
            break;
        case Shown::Remedy::picture:
            bench.view.resource.clear();
            bench.view.layer = 0;
            break;
        case Shown::Remedy::layer:
            bench.view.layer = lastLayer(bench);
            break;
        case Shown::Remedy::restart:
            bench.wantsRestart = true;
            break;
        case Shown::Remedy::none:
            break;
    }
}

}  // namespace

void drawShown(Bench& bench) {
    const Shown shown = shownOf(bench.requested(), *bench.result, *bench.reference, bench.whole);
    const ImVec4 color = colorOf(shown.kind);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled(
        {corner.x + 0.5f * height, corner.y + 0.5f * height}, 0.25f * height,
        ImGui::GetColorU32(color));
    ImGui::Dummy({height, height});
    if (shown.remedy != Shown::Remedy::none) {
        ImGui::SameLine();
        const bool isRestart = shown.remedy == Shown::Remedy::restart;
        if (button(bench, labelOf(shown.remedy).c_str(),
                   isRestart ? "status.restart" : "shown.remedy")) {
            go(bench, shown.remedy);
        }
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color, "%s", shown.sentence.c_str());
    bench.map.control("shown", nameOf(shown.kind));
    bench.map.control("shown.sentence", shown.sentence);
    const FrameResult& result = *bench.result;
    const bool isStale = shown.kind == Shown::Kind::stale;
    if (isStale && !result.problem.empty()) {
        bench.map.control("status.problem", result.problem);
    } else if (isStale && !result.shaderProblem.empty()) {
        bench.map.control("status.shader", result.shaderProblem);
        tooltip(result.shaderProblem);  // with its lines
        return;
    }
    // It may be longer than the window is wide.
    std::string whole = shown.sentence;
    for (const std::string& reservation : shown.reservations)
        whole += "\n" + reservation;
    tooltip(whole);
}

}  // namespace kaustik::gui
