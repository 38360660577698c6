// SPDX-License-Identifier: MIT
// The picture, the split, values of single pixels, and captions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/gui/panels/color_bar.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/picture_mouse.h"
#include "framework/gui/panels/picture_overlay.h"
#include "framework/gui/showing.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

// Above so many window pixels a pixel, its values are written into it.
constexpr float kPixelsForValues = 56.0f;

// `reduction`: how many of the document's pixels a side of the image's pixels stands for.
PictureFrame place(const ViewState& view, ImVec2 corner, ImVec2 size, const Image& image,
                   float reduction) {
    PictureFrame frame{corner, size, corner, corner, 1.0f, reduction, image.width, image.height};
    const auto width = static_cast<float>(image.width);
    const auto height = static_cast<float>(image.height);
    frame.zoom =
        view.zoom > 0.0f ? view.zoom * reduction : std::min(size.x / width, size.y / height);
    const glm::vec2 middle = view.zoom > 0.0f ? view.middle : glm::vec2(0.5f);
    frame.low = {std::round(corner.x + 0.5f * size.x - middle.x * width * frame.zoom),
                 std::round(corner.y + 0.5f * size.y - middle.y * height * frame.zoom)};
    frame.high = {frame.low.x + width * frame.zoom, frame.low.y + height * frame.zoom};
    return frame;
}

// What is seen of one image: all of the area, or one side of the split.
struct Part {
    std::size_t slot = 0;  // of the canvas
    const ShownImage* image = nullptr;
    PictureFrame frame;  // of the image, which may be a quick one
    float left = 0.0f;   // in the window
    float right = 0.0f;
    [[nodiscard]] bool isSeen() const { return right - left >= 1.0f; }
};

// What lies under a place in the window; null where there is nothing.
const Part* partAt(const std::vector<Part>& parts, ImVec2 mouse) {
    for (const Part& part : parts) {
        if (part.isSeen() && mouse.x >= part.left && mouse.x < part.right) return &part;
    }
    return nullptr;
}

// What there is of the area for pixels alone, and for words next to them, which cover none; values
// under the mouse are in the line below it.
struct Areas {
    ImVec2 corner;  // of the pixels
    ImVec2 size;
    float top = 0.0f;  // of the caption
};

Areas areasIn(const Bench& bench, ImVec2 corner, ImVec2 size, float left, float right) {
    const float line = ImGui::GetTextLineHeight() + static_cast<float>(bench.px(3.0));
    return {{corner.x + left, corner.y + line},
            {std::max(size.x - left - right, 1.0f), std::max(size.y - line, 1.0f)},
            corner.y};
}

void drawNumbers(const Bench& bench, const Part& part) {
    const PictureFrame& frame = part.frame;
    if (frame.zoom < kPixelsForValues * bench.scale) return;
    bench.map.area("picture.values", frame.corner.x, frame.corner.y, frame.size.x, frame.size.y);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const glm::ivec2 first = glm::floor(frame.pixelAt({part.left, frame.corner.y}));
    const glm::ivec2 last = glm::floor(frame.pixelAt({part.right, frame.corner.y + frame.size.y}));
    for (int y = std::max(first.y, 0); y <= std::min(last.y, frame.height - 1); ++y) {
        for (int x = std::max(first.x, 0); x <= std::min(last.x, frame.width - 1); ++x) {
            const std::string text = part.image->numbersAt({x, y});
            if (text.empty()) continue;
            const ImVec2 at = frame.windowAt({x, y});
            const ImVec2 size = ImGui::CalcTextSize(text.c_str());
            draw.AddRectFilled({at.x + 1.0f, at.y + 1.0f},
                               {at.x + size.x + 5.0f, at.y + size.y + 1.0f},
                               IM_COL32(0, 0, 0, 150));
            draw.AddText({at.x + 3.0f, at.y + 1.0f}, IM_COL32(255, 255, 255, 255), text.c_str());
        }
    }
}

// Names of the views that an image holds several of, and a ground for what is none of them.
void drawRegions(const Part& part) {
    const PictureFrame& frame = part.frame;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (const ViewedTexture::Region& region : part.image->regions) {
        const ImVec2 low = frame.windowAt({region.x, region.y});
        const ImVec2 high = frame.windowAt({region.x + region.width, region.y + region.height});
        draw.AddRect(low, high, IM_COL32(255, 255, 255, 90));
        draw.AddText({low.x + 6.0f, low.y + 4.0f}, IM_COL32(255, 255, 255, 255),
                     region.name.c_str());
    }
}

// Goes to the part of the texture that was chosen from the list.
void goToSoughtRegion(ViewState& view, const ShownImage& image, ImVec2 size) {
    if (view.soughtRegion.empty() || image.resource != view.resource) return;
    for (const ViewedTexture::Region& region : image.regions) {
        if (region.name != view.soughtRegion) continue;
        const glm::vec2 extent(region.width, region.height);
        view.zoom = std::min(size.x / extent.x, size.y / extent.y);
        view.middle = (glm::vec2(region.x, region.y) + 0.5f * extent) /
                      glm::vec2(image.values->width, image.values->height);
    }
    view.soughtRegion.clear();
}

// What an image is of.
void drawCaption(const Bench& bench, const Part& part, const Areas& areas, float left,
                 float right) {
    const std::string text = part.image->caption();
    const std::string name = part.slot == 0 ? "picture.caption" : "picture.caption.compared";
    const float room = std::max(right - left - static_cast<float>(bench.px(8.0)), 0.0f);
    bench.map.area(name, left, areas.top, room, ImGui::GetTextLineHeight(), text);
    cutLine(text, {left, areas.top},
            part.image->age.empty() ? IM_COL32(255, 255, 255, 255) : IM_COL32(255, 205, 90, 255),
            room);
}

void drawPart(Bench& bench, const Part& part) {
    const PictureFrame& frame = part.frame;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    bench.canvas.show(part.slot, *part.image->values, part.image->version, part.image->mapping);
    draw.PushClipRect({part.left, frame.corner.y}, {part.right, frame.corner.y + frame.size.y},
                      true);
    // It covers what is below it: blending would cost as much again on a software rasteriser.
    draw.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glDisable(GL_BLEND); }, nullptr);
    draw.AddImage(bench.canvas.texture(part.slot, frame.zoom), frame.low, frame.high);
    draw.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
    drawRegions(part);
    drawNumbers(bench, part);
    draw.PopClipRect();
}

void drawSplit(Bench& bench, const PictureFrame& frame, float splitX) {
    ImGui::GetWindowDrawList()->AddLine({splitX, frame.corner.y},
                                        {splitX, frame.corner.y + frame.size.y},
                                        IM_COL32(255, 255, 255, 200), 1.5f * bench.scale);
    bench.map.area("picture.split", splitX - 3.0f, frame.corner.y, 6.0f, frame.size.y,
                   fmt::format("{}", bench.view.split));
}

// In the place of an image.
void drawWords(Bench& bench, ImVec2 corner, ImVec2 size, const char* text) {
    ImGui::GetWindowDrawList()->AddText({corner.x + 12.0f, corner.y + 12.0f},
                                        IM_COL32(200, 200, 200, 255), text);
    bench.map.area("picture", corner.x, corner.y, size.x, size.y, "empty");
}

}  // namespace

void drawPicture(Bench& bench) {
    static thread_local DragState hand;  // of the one mouse that there is
    const ImVec2 whole = ImGui::GetCursorScreenPos();
    const ImVec2 wholeSize = ImGui::GetContentRegionAvail();
    if (wholeSize.x < 16.0f || wholeSize.y < 16.0f) return;
    bench.map.area("picture.pane", whole.x, whole.y, wholeSize.x, wholeSize.y);
    const Showing showing = showingOf(bench.requested(), *bench.result, *bench.reference);
    if (!showing.main) return drawWords(bench, whole, wholeSize, showing.words.c_str());
    const ShownImage& main = *showing.main;
    // One bar for both sides where they have one scale.
    const bool hasTwoBars = showing.compared && !(showing.compared->mapping == main.mapping);
    const ShownImage& right = hasTwoBars ? *showing.compared : main;
    const float leftBar = hasTwoBars ? barWidth(bench, main) : 0.0f;
    const Areas areas = areasIn(bench, whole, wholeSize, leftBar, barWidth(bench, right));
    const ImVec2 corner = areas.corner;
    const ImVec2 size = areas.size;
    if (size.x < 8.0f || size.y < 8.0f) return;
    ImGui::SetCursorScreenPos(corner);
    ImGui::InvisibleButton("picture", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    const bool isHovered = ImGui::IsItemHovered();
    const bool isActivated = ImGui::IsItemActivated();
    const bool isActive = ImGui::IsItemActive();
    ViewState& view = bench.view;
    // A quick picture has fewer pixels, and lies where the whole one does.
    const params::Extent extent = bench.result->document.size;
    const auto frameOf = [&](const ShownImage& image) {
        const bool isQuick = image.takesOverlay && image.values->width < extent.width;
        return place(
            view, corner, size, *image.values,
            isQuick ? static_cast<float>(extent.width) / static_cast<float>(image.values->width)
                    : 1.0f);
    };
    goToSoughtRegion(view, main, size);
    const PictureFrame frame = frameOf(main);
    const float end = corner.x + size.x;
    const float splitX =
        showing.compared ? frame.low.x + view.split * (frame.high.x - frame.low.x) : end;
    const float middle = std::clamp(splitX, corner.x, end);
    std::vector<Part> parts = {Part{0, &main, frame, corner.x, middle}};
    if (showing.compared)
        parts.push_back(Part{1, &*showing.compared, frameOf(*showing.compared), middle, end});

    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.PushClipRect(corner, {end, corner.y + size.y}, true);
    for (const Part& part : parts) {
        if (part.isSeen()) drawPart(bench, part);
    }
    int pointedLight = -1;
    if (main.takesOverlay) {
        drawPhotons(bench, frame);
        pointedLight =
            drawLights(bench, frame, isHovered, hand.hold == DragTarget::light ? hand.light : -1);
    }
    if (showing.compared) drawSplit(bench, frame, splitX);
    draw.PopClipRect();
    // Units of the bars are in the captions' line, above them.
    float captionBegin = whole.x + 4.0f;
    float captionEnd = whole.x + wholeSize.x;
    const ImU32 ink = IM_COL32(255, 255, 255, 255);
    if (const std::string unit = barUnit(right); !unit.empty()) {
        captionEnd -= ImGui::CalcTextSize(unit.c_str()).x + 2.0f;
        draw.AddText({captionEnd, areas.top}, ink, unit.c_str());
        captionEnd -= static_cast<float>(bench.px(8.0));
    }
    if (hasTwoBars) {
        const std::string unit = barUnit(main);
        draw.AddText({captionBegin, areas.top}, ink, unit.c_str());
        captionBegin += ImGui::CalcTextSize(unit.c_str()).x + static_cast<float>(bench.px(12.0));
    }
    for (const Part& part : parts) {
        if (!part.isSeen()) continue;
        const bool isFirst = &part == &parts.front() || !parts.front().isSeen();
        const bool isLast = &part == &parts.back() || !parts.back().isSeen();
        drawCaption(bench, part, areas, isFirst ? captionBegin : std::max(part.left, captionBegin),
                    isLast ? captionEnd : std::min(part.right, captionEnd));
    }
    drawColorBar(bench, right, {corner.x + size.x, corner.y}, size.y,
                 hasTwoBars ? "picture.bar.compared" : "picture.bar");
    if (hasTwoBars) drawColorBar(bench, main, {whole.x, corner.y}, size.y, "picture.bar");
    bench.map.area("picture", corner.x, corner.y, size.x, size.y,
                   frame.reduction > 1.0f ? "preview" : "whole");
    bench.map.area("picture.image", frame.low.x, frame.low.y, frame.high.x - frame.low.x,
                   frame.high.y - frame.low.y);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (const Part* part = partAt(parts, mouse); isHovered && part != nullptr)
        bench.valueUnderMouse = part->image->valuesAt(glm::floor(part->frame.pixelAt(mouse)));

    if (isActivated) {
        const bool isNearSplit =
            showing.compared && std::abs(mouse.x - splitX) < static_cast<float>(bench.px(6.0));
        hand = beginDrag(isNearSplit, pointedLight, main.takesOverlay);
    }
    if (isActive) {
        applyDrag(bench, frame, hand);
        if (hand.hold != DragTarget::none && hand.hasMoved) bench.isDragging = true;
    } else if (hand.hold != DragTarget::none) {
        const glm::ivec2 pixel = glm::floor(frame.pixelAt(mouse));
        const bool isClick = !hand.hasMoved && frame.contains(pixel) && view.probes;
        if (isClick && hand.hold == DragTarget::camera) {
            if (frame.width == extent.width && frame.height == extent.height)
                view.probePixel = pixel;
        } else if (isClick && hand.hold == DragTarget::middle) {
            bench.notify(
                fmt::format("Photons are probed at pixels of the eye's view, and {} is {}.",
                            main.name(), main.place),
                true, [resource = view.resource](const Bench& now) {
                    return !now.view.probes || now.view.resource != resource;
                });
        }
        hand = {};
    }
    if (isHovered) {
        useWheel(bench, frame, main.takesOverlay);
        if (main.takesOverlay) fly(bench);
    }
}

}  // namespace kaustik::gui
