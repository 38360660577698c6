// SPDX-License-Identifier: MIT
// The workbench's short cuts. They go by character, whatever the keyboard's layout (keys.h); while
// something is typed only function keys are any.
#define GLFW_INCLUDE_NONE  // OpenGL comes from epoxy
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "framework/gui/imgui_keys.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/workbench.h"

namespace kaustik::gui {

void Workbench::useKeys() {
    const ImGuiIO& io = ImGui::GetIO();
    if (isKeyPressed(GLFW_KEY_F1)) bench_.showsHelp = !bench_.showsHelp;
    if (isKeyPressed(GLFW_KEY_F5)) ++bench_.sceneReloads;
    if (isKeyPressed(GLFW_KEY_F12)) bench_.wantsScreenshot = true;
    // Alt is a part of AltGr on some systems, with which characters are typed.
    if (io.WantTextInput || io.KeyAlt || io.KeySuper) return;
    if (io.KeyCtrl) {
        if (isKeyPressed(GLFW_KEY_S)) bench_.wantsExperiment = true;
        if (isKeyPressed(GLFW_KEY_Q)) window_.close();
        if (isKeyPressed(GLFW_KEY_Z)) undo(io.KeyShift ? 1 : -1);
        if (isKeyPressed(GLFW_KEY_Y)) undo(1);
        return;
    }
    if (isKeyPressed(GLFW_KEY_SPACE) && !ImGui::IsAnyItemFocused())
        bench_.isPlaying = !bench_.isPlaying;
    if (isKeyPressed(GLFW_KEY_R)) bench_.document.edits.camera.reset();
    if (isKeyPressed(GLFW_KEY_L)) bench_.view.showsLights = !bench_.view.showsLights;
    if (isKeyPressed(GLFW_KEY_F)) bench_.view.isFalseColor = !bench_.view.isFalseColor;
    if (isKeyPressed(GLFW_KEY_P)) bench_.view.probes = !bench_.view.probes;
    // Signs and digits are on a key's upper half here and on its lower half there.
    for (const ImWchar character : io.InputQueueCharacters)
        useSign(character);
}

void Workbench::useSign(unsigned character) {
    switch (character) {
        case '.':
            if (!bench_.result->scene) break;
            bench_.isPlaying = false;
            bench_.document.edits.timeSeconds =
                bench_.timeSeconds() + double(bench_.panels.sequenceStep);
            break;
        case '0':
            bench_.view.zoom = 0.0f;
            break;
        case '+':
        case '=':  // a plus without Shift, on many keyboards
            bench_.view.exposureStops += 0.5f;
            break;
        case '-':
            bench_.view.exposureStops -= 0.5f;
            break;
        default:
            break;
    }
}

}  // namespace kaustik::gui
