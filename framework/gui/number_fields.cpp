// SPDX-License-Identifier: MIT
#include "framework/gui/number_fields.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace kaustik::gui {
namespace {

// The field that is being typed into; one at a time.
struct Typing {
    ImGuiID field = 0;
    int frame = 0;  // in which it was drawn last
    std::string text;
};
thread_local Typing typing;

template <class T>
std::string takenSentence(const std::string& label, T minimum, T maximum, const std::string& typed,
                          T taken) {
    return fmt::format("{} takes {} to {}: of {} it has taken {}.", label, minimum, maximum, typed,
                       taken);
}

template <class T>
void takeBack(Bench& bench, const std::string& label, T& value, T minimum, T maximum) {
    // What is no number leaves nothing to be next to.
    const T taken = value >= minimum ? std::min(value, maximum) : minimum;
    if (taken == value) return;
    bench.notifyTyped(takenSentence(label, minimum, maximum, fmt::format("{}", value), taken));
    value = taken;
}

}  // namespace

TypedCount typedCount(const std::string& label, const std::string& text, int minimum, int maximum) {
    const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
    const std::string typed = text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
    double number = 0.0;
    const auto [end, problem] = std::from_chars(typed.data(), typed.data() + typed.size(), number);
    const bool isAll = end == typed.data() + typed.size();
    const bool isWhole = isAll && problem == std::errc() && std::floor(number) == number;
    // Also of what is too small for a number, which says so by its exponent.
    const bool isTooLong = isAll && problem == std::errc::result_out_of_range &&
                           typed.find("e-") == std::string::npos &&
                           typed.find("E-") == std::string::npos;
    if (!isWhole && !isTooLong) {
        return {std::nullopt, fmt::format("{} takes a whole number from {} to {}, not '{}'.", label,
                                          minimum, maximum, typed)};
    }
    const bool isAbove = isTooLong ? !typed.starts_with('-') : number > maximum;
    const bool isBelow = isTooLong ? typed.starts_with('-') : number < minimum;
    if (!isAbove && !isBelow) return {static_cast<int>(number), ""};
    const int taken = isAbove ? maximum : minimum;
    return {taken, takenSentence(label, minimum, maximum, typed, taken)};
}

void inputCount(Bench& bench, const char* label, int& value, int minimum, int maximum,
                const std::string& name) {
    const ImGuiID field = ImGui::GetID(label);
    // One that was not drawn for a frame has lost what was typed.
    if (typing.field == field && ImGui::GetFrameCount() > typing.frame + 1) typing.field = 0;
    std::string text = typing.field == field ? typing.text : fmt::format("{}", value);
    ImGui::InputText(label, &text, ImGuiInputTextFlags_AutoSelectAll);
    bench.map.control(name, fmt::format("{}", value));
    if (ImGui::IsItemActive()) {
        typing = {field, ImGui::GetFrameCount(), text};
        return;
    }
    if (typing.field != field) return;
    typing.field = 0;
    if (text == fmt::format("{}", value)) return;
    const TypedCount typed = typedCount(label, text, minimum, maximum);
    if (!typed.problem.empty()) bench.notifyTyped(typed.problem);
    value = typed.value.value_or(value);
}

void keepWithin(Bench& bench, const std::string& label, float& value, float minimum,
                float maximum) {
    takeBack(bench, label, value, minimum, maximum);
}

void keepWithin(Bench& bench, const std::string& label, int& value, int minimum, int maximum) {
    takeBack(bench, label, value, minimum, maximum);
}

}  // namespace kaustik::gui
