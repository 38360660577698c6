// SPDX-License-Identifier: MIT
#include "framework/gui/screen_map.h"

#include <imgui.h>

#include "framework/core/files.h"

namespace kaustik::gui {
namespace {
constexpr auto kEvery = std::chrono::milliseconds(50);
}

void ScreenMap::beginFrame() {
    if (!isOn()) return;
    json_ = {{"frame", ImGui::GetFrameCount()},
             {"controls", nlohmann::json::object()},
             {"status", nlohmann::json::object()}};
}

void ScreenMap::control(const std::string& name, const std::string& value) {
    if (!isOn() || !ImGui::IsItemVisible()) return;
    const ImVec2 corner = ImGui::GetItemRectMin();
    const ImVec2 size = ImGui::GetItemRectSize();
    area(name, corner.x, corner.y, size.x, size.y, value);
}

void ScreenMap::area(const std::string& name, float x, float y, float width, float height,
                     const std::string& value) {
    if (!isOn()) return;
    json_["controls"][name] = {{"x", x}, {"y", y}, {"w", width}, {"h", height}, {"value", value}};
}

void ScreenMap::endFrame() {
    if (!isOn() || Clock::now() - written_ < kEvery) return;
    written_ = Clock::now();
    // Names of files may be no UTF-8.
    writeFileWhole(file_, json_.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace kaustik::gui
