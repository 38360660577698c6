// SPDX-License-Identifier: MIT
// The picture, the split, values of single pixels; and the hand on it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/gui/camera_control.h"
#include "framework/gui/imgui_keys.h"
#include "framework/gui/panels/panels.h"
#include "framework/gui/panels/picture_overlay.h"
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

ToneMapping mappingOf(const ViewState& view, bool isEncoded) {
    ToneMapping mapping;
    mapping.isEncoded = isEncoded;
    mapping.channel = view.channel;
    mapping.exposureStops = view.exposureStops;
    mapping.isFalseColor = view.isFalseColor;
    mapping.low = view.low;
    mapping.high = view.high;
    return mapping;
}

// What is seen to the right of the split; null where there is nothing (yet).
struct Other {
    const Image* image = nullptr;
    std::uint64_t version = 0;
    bool isEncoded = false;
    std::string name;
};

Other otherImage(const Bench& bench) {
    const FrameResult& result = *bench.result;
    const ReferenceState& reference = *bench.reference;
    switch (bench.view.sidePicture) {
        case SidePicture::none:
            break;
        case SidePicture::other: {
            const VariantResult& b = result.variants[1];
            if (b.viewed && !b.viewed->values.values.empty())
                return {&b.viewed->values, b.viewed->version, b.viewed->isEncoded, "B"};
            break;
        }
        case SidePicture::reference:
            if (reference.irradiance && hasSameView(reference, result.document))
                return {reference.irradiance.get(), 2 * reference.version, false, "reference"};
            break;
        case SidePicture::error:
            if (const ReferenceState::Judgement& judgement =
                    reference.judgements[bench.requested().seen()];
                judgement.heatMap && hasSameView(reference, result.document)) {
                return {judgement.heatMap.get(), 2 * reference.version + 1, true,
                        judgement.order == result.order ? "error" : "error of before"};
            }
            break;
    }
    return {};
}

void drawPixelValues(const Bench& bench, const PictureFrame& frame, const Image& image) {
    if (frame.zoom < kPixelsForValues * bench.scale) return;
    bench.map.area("picture.values", frame.corner.x, frame.corner.y, frame.size.x, frame.size.y);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const glm::ivec2 first = glm::floor(frame.pixelAt(frame.corner));
    const glm::ivec2 last =
        glm::floor(frame.pixelAt({frame.corner.x + frame.size.x, frame.corner.y + frame.size.y}));
    for (int y = std::max(first.y, 0); y <= std::min(last.y, image.height - 1); ++y) {
        for (int x = std::max(first.x, 0); x <= std::min(last.x, image.width - 1); ++x) {
            std::string text;
            for (int c = 0; c < image.channels; ++c)
                text += fmt::format("{}{:.4g}", c == 0 ? "" : "\n", image.at(x, y, c));
            const ImVec2 at = frame.windowAt({x, y});
            const ImVec2 size = ImGui::CalcTextSize(text.c_str());
            draw.AddRectFilled({at.x + 1.0f, at.y + 1.0f},
                               {at.x + size.x + 5.0f, at.y + size.y + 1.0f},
                               IM_COL32(0, 0, 0, 150));
            draw.AddText({at.x + 3.0f, at.y + 1.0f}, IM_COL32(255, 255, 255, 255), text.c_str());
        }
    }
}

void zoomAt(ViewState& view, const PictureFrame& frame, ImVec2 mouse, float factor) {
    const glm::vec2 pixel = frame.pixelAt(mouse);
    view.zoom = std::clamp(frame.zoom / frame.reduction * factor, 0.05f, 256.0f);
    // The pixel under the mouse stays there, also of a quick picture, which has fewer.
    const float zoom = view.zoom * frame.reduction;
    const glm::vec2 fromMiddle((mouse.x - frame.corner.x - 0.5f * frame.size.x) / zoom,
                               (mouse.y - frame.corner.y - 0.5f * frame.size.y) / zoom);
    view.middle = (pixel - fromMiddle) / glm::vec2(frame.width, frame.height);
}

void fly(Bench& bench) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || io.KeyCtrl || !bench.isSceneCurrent()) return;
    const auto key = [&](char c) { return isKeyDown(c) ? 1.0 : 0.0; };
    const glm::dvec3 way(key('D') - key('A'), key('E') - key('Q'), key('W') - key('S'));
    if (way == glm::dvec3(0.0)) return;
    const scene::Bounds& bounds = bench.result->scene->bounds;
    const double speed =
        0.25 * glm::length(bounds.maximum - bounds.minimum) * (io.KeyShift ? 4.0 : 1.0);
    const double seconds = std::min(double(io.DeltaTime), 0.1);
    bench.document.edits.camera = gui::fly(bench.camera(), speed * seconds * way);
    bench.isTurning = true;
}

// What the mouse holds while a button is down.
enum class DragTarget { none, camera, look, middle, split, light };

// A press that moves less is a click: no hand holds quite still. Pixels at scale 1.
constexpr double kClickPixels = 4.0;

struct DragState {
    DragTarget hold = DragTarget::none;
    int light = -1;
    ImVec2 pressed;  // where
    bool hasMoved = false;
    // Whether it changes what is worked on, and not only how it is seen.
    [[nodiscard]] bool changesDocument() const {
        return hold == DragTarget::camera || hold == DragTarget::look || hold == DragTarget::light;
    }
};

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

void drawCursorValue(Bench& bench, const PictureFrame& frame, const ViewedTexture& viewed,
                     const Other& other, float splitX) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::ivec2 pixel = glm::floor(frame.pixelAt(mouse));
    if (!frame.contains(pixel)) return;
    const bool isOther = other.image != nullptr && mouse.x >= splitX;
    const Image& image = isOther ? *other.image : viewed.values;
    // The other image may have another size while a frame is on its way.
    if (pixel.x >= image.width || pixel.y >= image.height) return;
    std::string text = fmt::format("({}, {})", pixel.x, pixel.y);
    for (int c = 0; c < image.channels; ++c)
        text += fmt::format("  {:.5g}", image.at(pixel.x, pixel.y, c));
    bench.map.area("picture.value", 0, 0, 0, 0, text);
    const ImVec2 at(frame.corner.x + 6.0f,
                    frame.corner.y + frame.size.y - 1.6f * ImGui::GetFontSize());
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({at.x - 4.0f, at.y - 2.0f}, {at.x + size.x + 4.0f, at.y + size.y + 2.0f},
                       IM_COL32(0, 0, 0, 170));
    draw.AddText(at, IM_COL32(255, 255, 255, 255), text.c_str());
}

// What the image left of the split is of, as it was rendered: it may be older than what is asked
// for.
void drawCaption(const Bench& bench, const PictureFrame& frame, const ViewedTexture& viewed) {
    const char* variant = !bench.document.other ? "" : bench.requested().seen() == 0 ? "A " : "B ";
    const std::string layer = viewed.layers > 1 ? fmt::format(", layer {}", viewed.layer) : "";
    const std::string text = fmt::format("{}{}{}", variant, viewed.name, layer);
    bench.map.area("picture.caption", 0, 0, 0, 0, text);
    if (text.empty()) return;
    const ImVec2 at(frame.corner.x + 6.0f, frame.corner.y + 4.0f);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({at.x - 4.0f, at.y - 2.0f}, {at.x + size.x + 4.0f, at.y + size.y + 2.0f},
                       IM_COL32(0, 0, 0, 170));
    draw.AddText(at, IM_COL32(255, 255, 255, 255), text.c_str());
}

void drawOther(Bench& bench, const PictureFrame& frame, const Other& other, float splitX) {
    const ImVec2 corner = frame.corner;
    const ImVec2 size = frame.size;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    bench.canvas.show(1, *other.image, other.version, mappingOf(bench.view, other.isEncoded));
    draw.PushClipRect({splitX, corner.y}, {corner.x + size.x, corner.y + size.y}, true);
    draw.AddImage(bench.canvas.texture(1), frame.low, frame.high);
    draw.PopClipRect();
    draw.AddLine({splitX, corner.y}, {splitX, corner.y + size.y}, IM_COL32(255, 255, 255, 200),
                 1.5f * bench.scale);
    draw.AddText({splitX + 6.0f, corner.y + 4.0f}, IM_COL32(255, 255, 255, 255),
                 other.name.c_str());
    bench.map.area("picture.split", splitX - 3.0f, corner.y, 6.0f, size.y,
                   fmt::format("{}", bench.view.split));
}

// What a press takes hold of.
DragState beginDrag(bool isNearSplit, int pointedLight) {
    DragState hand;
    hand.pressed = ImGui::GetIO().MousePos;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
        hand.hold = DragTarget::look;
    } else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
        hand.hold = DragTarget::middle;
    } else if (pointedLight >= 0) {
        hand.hold = DragTarget::light;
        hand.light = pointedLight;
    } else {
        hand.hold = isNearSplit ? DragTarget::split : DragTarget::camera;
    }
    return hand;
}

void useWheel(Bench& bench, const PictureFrame& frame) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseWheel == 0.0f) return;
    if (io.KeyCtrl && bench.isSceneCurrent()) {
        bench.document.edits.camera = dolly(bench.camera(), double(io.MouseWheel));
        bench.isTurning = true;
    } else {
        zoomAt(bench.view, frame, io.MousePos, std::pow(1.25f, io.MouseWheel));
    }
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
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::GetContentRegionAvail();
    if (size.x < 16.0f || size.y < 16.0f) return;
    ImGui::InvisibleButton("picture", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    const bool isHovered = ImGui::IsItemHovered();
    const bool isActivated = ImGui::IsItemActivated();
    const bool isActive = ImGui::IsItemActive();
    const VariantResult& shown = bench.result->variants[bench.requested().seen()];
    if (!shown.viewed) {
        const bool isToCome = bench.result->problem.empty() && shown.error.empty();
        return drawWords(
            bench, corner, size,
            isToCome ? "The first picture is being rendered …" : "There is nothing to show.");
    }
    const ViewedTexture& viewed = *shown.viewed;
    if (viewed.missing == ViewedTexture::Missing::layer)
        return drawWords(bench, corner, size, "There is no such layer.");
    ViewState& view = bench.view;
    // A preview has fewer pixels, and lies where the whole picture does.
    const params::Extent whole = bench.result->document.size;
    const float reduction =
        shown.isPreview ? static_cast<float>(whole.width) / static_cast<float>(viewed.values.width)
                        : 1.0f;
    const PictureFrame frame = place(view, corner, size, viewed.values, reduction);
    const bool hasPixelsOfDocument =
        viewed.values.width == whole.width && viewed.values.height == whole.height;
    const Other other = otherImage(bench);
    const float splitX = other.image != nullptr
                             ? frame.low.x + view.split * (frame.high.x - frame.low.x)
                             : corner.x + size.x;

    ImDrawList& draw = *ImGui::GetWindowDrawList();
    bench.canvas.show(0, viewed.values, viewed.version, mappingOf(view, viewed.isEncoded));
    draw.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    draw.AddImage(bench.canvas.texture(0), frame.low, frame.high);
    if (other.image != nullptr) drawOther(bench, frame, other, splitX);
    drawPixelValues(bench, frame, viewed.values);
    drawPhotons(bench, frame);
    const int pointedLight =
        drawLights(bench, frame, isHovered, hand.hold == DragTarget::light ? hand.light : -1);
    drawCaption(bench, frame, viewed);
    draw.PopClipRect();
    bench.map.area("picture", corner.x, corner.y, size.x, size.y,
                   shown.isPreview ? "preview" : "whole");
    bench.map.area("picture.image", frame.low.x, frame.low.y, frame.high.x - frame.low.x,
                   frame.high.y - frame.low.y);
    if (isHovered) drawCursorValue(bench, frame, viewed, other, splitX);

    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (isActivated) {
        const bool isNearSplit = other.image != nullptr &&
                                 std::abs(mouse.x - splitX) < static_cast<float>(bench.px(6.0));
        hand = beginDrag(isNearSplit, pointedLight);
    }
    if (isActive) {
        applyDrag(bench, frame, hand);
        if (hand.hold != DragTarget::none && hand.hasMoved) bench.isDragging = true;
    } else if (hand.hold != DragTarget::none) {
        const glm::ivec2 pixel = glm::floor(frame.pixelAt(mouse));
        if (!hand.hasMoved && hand.hold == DragTarget::camera && view.probes &&
            hasPixelsOfDocument && frame.contains(pixel))
            view.probePixel = pixel;
        hand = {};
    }
    if (isHovered) {
        useWheel(bench, frame);
        fly(bench);
    }
}

}  // namespace kaustik::gui
