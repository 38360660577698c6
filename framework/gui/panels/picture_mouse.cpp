// SPDX-License-Identifier: MIT
#include "framework/gui/panels/picture_mouse.h"

#include <algorithm>
#include <cmath>

#include "framework/gui/camera_control.h"

namespace kaustik::gui {
namespace {

// A press that moves less is a click: no hand holds quite still. Pixels at scale 1.
constexpr double kClickPixels = 4.0;

void zoomAt(ViewState& view, const PictureFrame& frame, ImVec2 mouse, float factor) {
    const glm::vec2 pixel = frame.pixelAt(mouse);
    view.zoom = std::clamp(frame.zoom / frame.reduction * factor, 0.05f, 256.0f);
    // The pixel under the mouse stays there, also of a quick picture, which has fewer.
    const float zoom = view.zoom * frame.reduction;
    const glm::vec2 fromMiddle((mouse.x - frame.corner.x - 0.5f * frame.size.x) / zoom,
                               (mouse.y - frame.corner.y - 0.5f * frame.size.y) / zoom);
    view.middle = (pixel - fromMiddle) / glm::vec2(frame.width, frame.height);
}

// The way of the mouse that counts in this frame; 0 before a press is more than a click.
glm::dvec2 dragPath(const Bench& bench, const DragState& hand) {
    const ImGuiIO& io = ImGui::GetIO();
    if (hand.hasMoved || !hand.changesDocument()) return {io.MouseDelta.x, io.MouseDelta.y};
    const glm::dvec2 whole(io.MousePos.x - hand.pressed.x, io.MousePos.y - hand.pressed.y);
    return glm::length(whole) < bench.px(kClickPixels) ? glm::dvec2(0.0) : whole;
}

void dragHeldLight(Bench& bench, const PictureFrame& frame, int index, glm::dvec2 pixels) {
    if (!bench.isSceneCurrent() ||
        static_cast<std::size_t>(index) >= bench.result->scene->lights.size()) {
        return;  // another scene came under the hand
    }
    const SceneFacts& facts = *bench.result->scene;
    const scene::Light light =
        withEdits(facts.lights[static_cast<std::size_t>(index)], bench.document.edits);
    const scene::Light moved = dragLight(light, facts.bounds, eyeViewOf(bench, frame), pixels);
    scene::LightEdit& edit = bench.document.edits.lights[light.name];
    if (light.kind == scene::LightKind::directional) {
        edit.direction = moved.direction;
    } else {
        edit.position = moved.position;
    }
}

}  // namespace

DragState beginDrag(bool isNearSplit, int pointedLight, bool isEyes) {
    DragState hand;
    hand.pressed = ImGui::GetIO().MousePos;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
        hand.hold = isEyes ? DragTarget::look : DragTarget::middle;
    } else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
        hand.hold = DragTarget::middle;
    } else if (pointedLight >= 0) {
        hand.hold = DragTarget::light;
        hand.light = pointedLight;
    } else {
        hand.hold = isNearSplit ? DragTarget::split
                    : isEyes    ? DragTarget::camera
                                : DragTarget::middle;
    }
    return hand;
}

void applyDrag(Bench& bench, const PictureFrame& frame, DragState& hand) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 way = dragPath(bench, hand);
    if (way == glm::dvec2(0.0) || hand.hold == DragTarget::none) return;
    hand.hasMoved = true;
    ViewState& view = bench.view;
    const double height = double(frame.high.y) - double(frame.low.y);
    switch (hand.hold) {
        case DragTarget::camera:
            if (!bench.isSceneCurrent()) return;
            bench.document.edits.camera = orbit(bench.camera(), way, height);
            bench.isTurning = true;
            break;
        case DragTarget::look:
            if (!bench.isSceneCurrent()) return;
            bench.document.edits.camera = look(bench.camera(), way, height);
            bench.isTurning = true;
            break;
        case DragTarget::middle:
            if (view.zoom <= 0.0f) zoomAt(view, frame, io.MousePos, 1.0f);
            view.middle -= glm::vec2(way) / (frame.zoom * glm::vec2(frame.width, frame.height));
            break;
        case DragTarget::split:
            view.split = std::clamp(
                (io.MousePos.x - frame.low.x) / std::max(frame.high.x - frame.low.x, 1.0f), 0.0f,
                1.0f);
            break;
        case DragTarget::light:
            dragHeldLight(bench, frame, hand.light, way / double(frame.zoom));
            bench.isTurning = true;
            break;
        case DragTarget::none:
            break;
    }
}

void useWheel(Bench& bench, const PictureFrame& frame, bool isEyes) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseWheel == 0.0f) return;
    if (io.KeyCtrl && isEyes && bench.isSceneCurrent()) {
        bench.document.edits.camera = dolly(bench.camera(), double(io.MouseWheel));
        bench.isTurning = true;
    } else {
        zoomAt(bench.view, frame, io.MousePos, std::pow(1.25f, io.MouseWheel));
    }
}

void fly(Bench& bench) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || io.KeyCtrl || !bench.isSceneCurrent()) return;
    const glm::dvec3 way = bench.flight;
    if (way == glm::dvec3(0.0)) return;
    const scene::Bounds& bounds = bench.result->scene->bounds;
    const double speed =
        0.25 * glm::length(bounds.maximum - bounds.minimum) * (io.KeyShift ? 4.0 : 1.0);
    bench.document.edits.camera = gui::fly(bench.camera(), speed * glm::clamp(way, -0.1, 0.1));
    bench.isTurning = true;
}

}  // namespace kaustik::gui
