// SPDX-License-Identifier: MIT
#include "framework/gui/panels/picture_choice.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

const char* nameOf(Thumbnail::State state) {
    switch (state) {
        case Thumbnail::State::waiting:
            return "waiting";
        case Thumbnail::State::rendering:
            return "rendering";
        case Thumbnail::State::there:
            return "there";
        case Thumbnail::State::failed:
            break;
    }
    return "failed";
}

// The picture, or in its place what there is to say.
void drawThumbnail(Bench& bench, std::size_t index, const Thumbnail& thumbnail, ImVec2 low,
                   ImVec2 high) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(low, high, IM_COL32(16, 16, 20, 255));
    if (thumbnail.image && index < Canvas::kChoices) {
        ToneMapping mapping;
        mapping.isEncoded = true;
        const std::size_t slot = Canvas::kFirstChoice + index;
        bench.canvas.show(slot, *thumbnail.image, thumbnail.version, mapping);
        const float zoom = (high.x - low.x) / static_cast<float>(thumbnail.image->width);
        draw.AddImage(bench.canvas.texture(slot, zoom), low, high);
        return;
    }
    const char* words = thumbnail.state == Thumbnail::State::rendering ? "rendering …"
                        : thumbnail.state == Thumbnail::State::failed  ? "cannot run"
                                                                       : "";
    draw.AddText({low.x + 6.0f, low.y + 4.0f}, ImGui::GetColorU32(ImGuiCol_TextDisabled), words);
}

// True where it is chosen.
bool drawOption(Bench& bench, const std::string& name, const PictureOption& option,
                std::size_t index, bool isCurrent, ImVec2 size) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight();
    const bool isChosen =
        ImGui::InvisibleButton(option.name.c_str(), {size.x, size.y + line + 4.0f});
    const bool isSeen = ImGui::IsItemVisible();
    const bool isPointedAt = ImGui::IsItemHovered() || ImGui::IsItemFocused();
    const Thumbnail thumbnail = bench.thumbnails->of(option.subject);
    // The one that is pointed at comes first.
    std::vector<ThumbnailSubject>& wanted = bench.wantedThumbnails;
    if (isSeen) wanted.insert(isPointedAt ? wanted.begin() : wanted.end(), option.subject);
    bench.map.control(name + "=" + option.name, nameOf(thumbnail.state));
    std::string words = option.name;
    if (!option.sentence.empty()) words += "\n" + option.sentence;
    if (!thumbnail.problem.empty()) words += "\n" + thumbnail.problem;
    tooltip(words);
    const ImVec2 high(corner.x + size.x, corner.y + size.y);
    drawThumbnail(bench, index, thumbnail, corner, high);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (isCurrent || isPointedAt) {
        draw.AddRect(corner, high,
                     isCurrent ? IM_COL32(255, 190, 64, 255) : IM_COL32(255, 255, 255, 200), 0.0f,
                     0, 2.0f * bench.scale);
    }
    draw.PushClipRect({corner.x, high.y}, {high.x, high.y + line + 4.0f}, true);
    draw.AddText({corner.x, high.y + 2.0f}, ImGui::GetColorU32(ImGuiCol_Text), option.name.c_str());
    draw.PopClipRect();
    return isChosen;
}

}  // namespace

std::optional<std::size_t> chooseByPicture(Bench& bench, const std::string& name,
                                           const std::string& title,
                                           const std::vector<PictureOption>& options,
                                           const std::string& current) {
    const std::string id = title + "###" + name;
    if (button(bench, "By picture", name)) ImGui::OpenPopup(id.c_str());
    tooltip(title + ".");
    const ImGuiViewport* viewport = ImGui::GetMainViewport();
    ImGui::SetNextWindowSize({0.75f * viewport->WorkSize.x, 0.8f * viewport->WorkSize.y});
    ImGui::SetNextWindowPos({viewport->WorkPos.x + 0.5f * viewport->WorkSize.x,
                             viewport->WorkPos.y + 0.5f * viewport->WorkSize.y},
                            ImGuiCond_Always, {0.5f, 0.5f});
    std::optional<std::size_t> chosen;
    bool isOpen = true;
    if (!ImGui::BeginPopupModal(
            id.c_str(), &isOpen,
            ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings))
        return chosen;
    ImGui::TextDisabled(
        "Rendered once, small, by its own defaults but for 128x128 photons; Escape closes it.");
    ImGui::BeginChild("pictures");
    const auto width = static_cast<float>(bench.px(kThumbnailSize.width));
    const ImVec2 size(width, width * static_cast<float>(kThumbnailSize.height) /
                                 static_cast<float>(kThumbnailSize.width));
    const float gap = static_cast<float>(bench.px(8.0));
    const auto columns = static_cast<std::size_t>(
        std::max(1.0f, (ImGui::GetContentRegionAvail().x + gap) / (width + gap)));
    for (std::size_t i = 0; i < options.size(); ++i) {
        if (i % columns != 0) ImGui::SameLine(0.0f, gap);
        if (drawOption(bench, name, options[i], i, options[i].name == current, size)) chosen = i;
    }
    ImGui::EndChild();
    if (chosen || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return chosen;
}

}  // namespace kaustik::gui
