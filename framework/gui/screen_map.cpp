// SPDX-License-Identifier: MIT
#include "framework/gui/screen_map.h"

#include <imgui.h>

#include <algorithm>

#include "framework/core/files.h"
#include "framework/core/json_text.h"

namespace kaustik::gui {
namespace {
constexpr auto kWriteInterval = std::chrono::milliseconds(15);
}

void ScreenMap::beginFrame() {
    if (!isOn()) return;
    json_ = {{"frame", ImGui::GetFrameCount()},
             {"controls", nlohmann::json::object()},
             {"status", nlohmann::json::object()}};
}

void ScreenMap::control(const std::string& name, const std::string& value) {
    if (!isOn() || !ImGui::IsItemVisible()) return;
    // Only what can be seen of it.
    const ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 clipLow = draw.GetClipRectMin();
    const ImVec2 clipHigh = draw.GetClipRectMax();
    const ImVec2 low(std::max(ImGui::GetItemRectMin().x, clipLow.x),
                     std::max(ImGui::GetItemRectMin().y, clipLow.y));
    const ImVec2 high(std::min(ImGui::GetItemRectMax().x, clipHigh.x),
                      std::min(ImGui::GetItemRectMax().y, clipHigh.y));
    if (high.x > low.x && high.y > low.y)
        area(name, low.x, low.y, high.x - low.x, high.y - low.y, value);
}

void ScreenMap::area(const std::string& name, float x, float y, float width, float height,
                     const std::string& value) {
    if (!isOn()) return;
    json_["controls"][name] = {{"x", x}, {"y", y}, {"w", width}, {"h", height}, {"value", value}};
}

void ScreenMap::endFrame() {
    if (!isOn() || Clock::now() - written_ < kWriteInterval) return;
    written_ = Clock::now();
    // Names of files may be no UTF-8.
    writeFileWhole(file_, jsonText(json_, 1));
}

}  // namespace kaustik::gui
