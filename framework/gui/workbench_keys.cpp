// SPDX-License-Identifier: MIT
// The workbench's short cuts. They go by character, whatever the keyboard's layout (keys.h), but
// for flying, which goes by place; while something is typed only function keys are any.
#define GLFW_INCLUDE_NONE  // OpenGL comes from epoxy
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "framework/gui/imgui_keys.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/showing.h"
#include "framework/gui/workbench.h"

namespace kaustik::gui {
namespace {

// Whether a list or a window of pictures is open, whose keys these are then.
bool isChoosing() {
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

// All of them, or, where none is there, the one to the right.
void hidePanels(PanelState& panels) {
    const bool isAny = panels.isLeftOpen || panels.isRightOpen || panels.isChartOpen;
    panels.isLeftOpen = false;
    panels.isChartOpen = false;
    panels.isRightOpen = !isAny;
}

}  // namespace

void Workbench::useKeys() {
    typePointForComma();
    const ImGuiIO& io = ImGui::GetIO();
    const auto held = [&](int place) { return window_.heldSeconds(place); };
    // Flying goes by place: the four keys lie together, whatever is printed on them.
    bench_.flight = {held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_E) - held(GLFW_KEY_Q),
                     held(GLFW_KEY_W) - held(GLFW_KEY_S)};
    for (const Window::KeyPress& press : window_.keyPresses())
        useKey(press);
    // Alt is a part of AltGr on some systems, with which characters are typed.
    if (io.WantTextInput || isChoosing() || io.KeyAlt || io.KeySuper || io.KeyCtrl) return;
    // Signs and digits are on a key's upper half here and on its lower half there.
    for (const ImWchar character : io.InputQueueCharacters)
        useSign(character);
}

// From where it is, also if that was found by itself.
void Workbench::changeExposure(float stops) {
    const Showing showing = showingOf(bench_.requested(), *bench_.result, *bench_.reference);
    if (!showing.main || showing.main->mapping.isEncoded) return;
    Look& look = bench_.view.looks[showing.main->resource];
    look.exposureStops =
        std::clamp(showing.main->mapping.exposureStops + stops, -kMaxStops, kMaxStops);
    look.isExposureAutomatic = false;
}

// Of a press, not of its repeats.
void Workbench::useKey(const Window::KeyPress& press) {
    if (press.key == GLFW_KEY_F1) bench_.showsHelp = !bench_.showsHelp;
    if (press.key == GLFW_KEY_F5) ++bench_.sceneReloads;
    if (press.key == GLFW_KEY_F12) bench_.wantsScreenshot = true;
    PanelState& panels = bench_.panels;
    if (press.key == GLFW_KEY_F2) {
        panels.isLeftOpen = !panels.isLeftOpen;
        if (panels.isLeftOpen && panels.leftTabs.empty()) {
            bench_.notify(
                "There is no panel to the left; the arrow next to their names moves one there.",
                false, [](const Bench& bench) {
                    return !bench.panels.isLeftOpen || !bench.panels.leftTabs.empty();
                });
        }
    }
    if (press.key == GLFW_KEY_F3) panels.isRightOpen = !panels.isRightOpen;
    if (press.key == GLFW_KEY_F4) panels.isChartOpen = !panels.isChartOpen;
    if (ImGui::GetIO().WantTextInput || isChoosing() ||
        (press.modifiers & (GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) {
        return;
    }
    if ((press.modifiers & GLFW_MOD_CONTROL) != 0) {
        if (press.key == GLFW_KEY_S) bench_.wantsExperiment = true;
        if (press.key == GLFW_KEY_Q) window_.close();
        if (press.key == GLFW_KEY_Z) undo((press.modifiers & GLFW_MOD_SHIFT) != 0 ? 1 : -1);
        if (press.key == GLFW_KEY_Y) undo(1);
        return;
    }
    if (press.key == GLFW_KEY_SPACE && !ImGui::IsAnyItemFocused())
        bench_.isPlaying = !bench_.isPlaying;
    if (press.key == GLFW_KEY_R) bench_.document.edits.camera.reset();
    if (press.key == GLFW_KEY_L) bench_.view.showsLights = !bench_.view.showsLights;
    if (press.key == GLFW_KEY_F) {
        if (Look* look = bench_.shownLook()) look->isFalseColor = !look->isFalseColor;
    }
    if (press.key == GLFW_KEY_K) keepVariant(bench_);
    if (press.key == GLFW_KEY_H) hidePanels(panels);
    if (press.key == GLFW_KEY_G) panels.showsGraph = !panels.showsGraph;
    if (press.key == GLFW_KEY_P) bench_.view.probes = !bench_.view.probes;
}

void Workbench::useSign(unsigned character) {
    switch (character) {
        case '.':
            if (!bench_.result->scene) break;
            bench_.isPlaying = false;
            bench_.document.edits.timeSeconds =
                bench_.timeSeconds() + double(bench_.panels.sequenceStep);
            break;
        case '1':
        case '2':
        case '3':
        case '4':
        case '5':
        case '6':
        case '7':
        case '8':
        case '9': {
            const int index = static_cast<int>(character - '1');
            if (index >= static_cast<int>(bench_.kept.size())) {
                bench_.notify(
                    fmt::format("There is no kept variant {}; K keeps what is shown.", index + 1));
            } else {
                bench_.view.flipped = bench_.view.flipped == index ? -1 : index;
            }
            break;
        }
        case '0':
            bench_.view.zoom = 0.0f;
            break;
        case '+':
        case '=':  // a plus without Shift, on many keyboards
            changeExposure(0.5f);
            break;
        case '-':
            changeExposure(-0.5f);
            break;
        default:
            break;
    }
}

}  // namespace kaustik::gui
