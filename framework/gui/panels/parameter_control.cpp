// SPDX-License-Identifier: MIT
#include "framework/gui/panels/parameter_control.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <limits>
#include <variant>

#include "framework/core/overloaded.h"
#include "framework/gui/typed_value.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

// The number's field that is being typed into; one at a time.
struct Typing {
    ImGuiID field = 0;
    int frame = 0;  // in which it was drawn last
    bool isNew = false;
    std::string text;
};

ParameterChange changeBy(const TypedValue& typed) {
    return {!typed.text.empty(), typed.text, typed.problem};
}

thread_local Typing typing;

// After its slider: Return on one that the keyboard is on begins to type, as Ctrl and a click do.
void typeOnReturn(const params::NamedField& named, const std::string& id) {
    if (!ImGui::IsItemFocused() || ImGui::IsItemActive()) return;
    if (!ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false)) return;
    typing = {ImGui::GetID(id.c_str()), ImGui::GetFrameCount(), true, named.field.text()};
}

// In a slider's place while its number is typed: the slider's own field leaves out what it does not
// know, and reads 0,05 as 5. Whether it is there; Ctrl and a click on the slider begin it.
bool typeNumber(const params::NamedField& named, const std::string& id, ParameterChange& change) {
    const ImGuiID field = ImGui::GetID(id.c_str());
    // One that was not drawn for a frame has lost what was typed.
    if (typing.field == field && ImGui::GetFrameCount() > typing.frame + 1) typing.field = 0;
    if (typing.field != field) {
        const ImVec2 low = ImGui::GetCursorScreenPos();
        const ImVec2 high(low.x + ImGui::CalcItemWidth(), low.y + ImGui::GetFrameHeight());
        const bool begins = ImGui::GetIO().KeyCtrl && ImGui::IsMouseClicked(0) &&
                            ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high);
        if (!begins) return false;
        typing = {field, 0, true, named.field.text()};
    }
    typing.frame = ImGui::GetFrameCount();
    if (typing.isNew) ImGui::SetKeyboardFocusHere();
    const bool isEntered =
        ImGui::InputText((id + ".typed").c_str(), &typing.text,
                         ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
    const bool isOver = isEntered || ImGui::IsItemDeactivated();
    if (isOver && !typing.isNew) {
        typing.field = 0;
        // Escape has put back what was there.
        change.problem = "";
        if (typing.text != named.field.text()) change = changeBy(typedValue(named, typing.text));
    }
    if (ImGui::IsItemActive()) typing.isNew = false;
    return true;
}

bool isLogarithmic(const params::Field& field) {
    // A range that begins at 0 does so for "none" or "as needed"; 1 is its first step.
    const double minimum = field.minimum == 0.0 ? 1.0 : field.minimum;
    constexpr double kWide = 10.0;
    return minimum > 0.0 && field.maximum > kWide * minimum;
}

// A whole number's slider, of which each place is a value that the parameter takes; nothing while
// it stays as it is.
std::optional<int> slide(const params::Field& field, const std::string& id, int value,
                         ImGuiSliderFlags flags) {
    if (field.values.empty()) {
        const bool isMoved = ImGui::SliderInt(id.c_str(), &value, static_cast<int>(field.minimum),
                                              static_cast<int>(field.maximum), "%d", flags);
        return isMoved ? std::optional(value) : std::nullopt;
    }
    const auto begin = field.values.begin();
    auto place = static_cast<int>(std::find(begin, field.values.end(), value) - begin);
    const bool isMoved =
        ImGui::SliderInt(id.c_str(), &place, 0, static_cast<int>(field.values.size()) - 1,
                         fmt::format("{}", value).c_str(), flags & ~ImGuiSliderFlags_Logarithmic);
    return isMoved ? std::optional(begin[place]) : std::nullopt;
}

}  // namespace

ParameterChange drawParameter(Bench& bench, const params::NamedField& named,
                              const std::string& label, const std::string& noEffect) {
    const params::Field& field = named.field;
    const std::string id = label + "##" + named.fullName;
    const std::string control = "parameter." + named.fullName;
    ParameterChange change;
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput |
        (isLogarithmic(field) ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    std::visit(
        Overloaded{[&](const bool* v) {
                       bool value = *v;
                       if (ImGui::Checkbox(id.c_str(), &value))
                           change = {true, value ? "true" : "false", ""};
                   },
                   [&](const int* v) {
                       if (typeNumber(named, id, change)) return;
                       if (const std::optional<int> value = slide(field, id, *v, flags))
                           change = {true, fmt::format("{}", *value), ""};
                       typeOnReturn(named, id);
                   },
                   [&](const float* v) {
                       if (typeNumber(named, id, change)) return;
                       float value = *v;
                       if (ImGui::SliderFloat(id.c_str(), &value, static_cast<float>(field.minimum),
                                              static_cast<float>(field.maximum), "%.5g", flags)) {
                           change = {true, fmt::format("{}", value), ""};
                       }
                       typeOnReturn(named, id);
                   },
                   [&](const params::Extent* v) {
                       params::Extent value = *v;
                       // What is out of range is said, and not only taken back.
                       if (inputExtent(id.c_str(), value, std::numeric_limits<int>::min(),
                                       std::numeric_limits<int>::max()))
                           change = changeBy(typedExtent(named, value));
                   },
                   [&](params::ChoiceRef v) {
                       int index = *v.index;
                       if (choose(bench, id.c_str(), field.choices, index, control))
                           change = {true, field.choices[static_cast<std::size_t>(index)], ""};
                   }},
        field.target);
    bench.map.control(control, field.text());
    std::string explanation = fmt::format("{}\n{}", named.fullName, field.sentence);
    if (!field.unit.empty()) explanation += fmt::format("\nUnit: {}", field.unit);
    if (!field.rangeText().empty()) explanation += fmt::format("\nRange: {}", field.rangeText());
    explanation += fmt::format("\nDefault: {}", named.defaultText);
    if (!noEffect.empty()) explanation += "\n" + noEffect;
    if (std::holds_alternative<float*>(field.target) || std::holds_alternative<int*>(field.target))
        explanation += "\nCtrl and click, or Return, to type a value.";
    tooltip(explanation);
    return change;
}

}  // namespace kaustik::gui
