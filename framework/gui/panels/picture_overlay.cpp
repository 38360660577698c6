// SPDX-License-Identifier: MIT
#include "framework/gui/panels/picture_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/gui/camera_control.h"
#include "framework/gui/light_marker.h"
#include "framework/gui/widgets.h"

namespace kaustik::gui {
namespace {

constexpr ImU32 kLightColor = IM_COL32(255, 210, 60, 230);
constexpr ImU32 kHeldColor = IM_COL32(255, 255, 160, 255);
constexpr ImU32 kFaintColor = IM_COL32(255, 210, 60, 110);

ImVec2 windowPoint(const glm::dvec2& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

PictureArea areaOf(const PictureFrame& frame) {
    const glm::dvec2 corner(frame.corner.x, frame.corner.y);
    return {corner,
            corner + glm::dvec2(frame.size.x, frame.size.y),
            {frame.low.x, frame.low.y},
            double(frame.zoom)};
}

// A ring with a middle; one that only points the way has an arrow's head, and no middle where the
// light is behind the eye.
void drawMarker(const LightMarker& marker, float radius, ImU32 color, float scale) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 place = windowPoint(marker.place);
    draw.AddCircleFilled(place, radius, IM_COL32(0, 0, 0, 140));
    draw.AddCircle(place, radius, color, 0, 2.0f * scale);
    if (!marker.isBehind) draw.AddCircleFilled(place, 0.4f * radius, color);
    if (marker.direction == glm::dvec2(0.0)) return;
    const auto size = static_cast<double>(radius);
    const glm::dvec2 across(-marker.direction.y, marker.direction.x);
    const glm::dvec2 base = marker.place + 1.2 * size * marker.direction;
    draw.AddTriangleFilled(windowPoint(base + 0.8 * size * marker.direction),
                           windowPoint(base + 0.7 * size * across),
                           windowPoint(base - 0.7 * size * across), color);
}

// Whence a directional light comes to the middle of the scene.
void drawWayToMiddle(const Bench& bench, const PictureFrame& frame, const render::RasterView& view,
                     const LightMarker& marker) {
    const scene::Bounds& bounds = bench.result->scene->bounds;
    const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
    const Projected seen = project(view, glm::vec3(view.worldToView * glm::dvec4(middle, 1.0)));
    if (!seen.visible) return;
    ImGui::GetWindowDrawList()->AddLine(windowPoint(marker.place), frame.windowAt(seen.pixel),
                                        kFaintColor, 1.5f * bench.scale);
}

const char* describe(const LightMarker& marker) {
    if (marker.isBehind) return "is that way, behind the eye; the panel Scene moves it";
    return marker.direction == glm::dvec2(0.0) ? "drag to move it" : "is that way; drag to move it";
}

}  // namespace

render::RasterView eyeViewOf(const Bench& bench, const PictureFrame& frame) {
    return render::makeEyeView(bench.camera(), frame.width, frame.height);
}

int drawLights(Bench& bench, const PictureFrame& frame, bool isHovered, int held) {
    if (!bench.view.showsLights || !bench.isSceneCurrent()) return -1;
    const SceneFacts& facts = *bench.result->scene;
    const render::RasterView view = eyeViewOf(bench, frame);
    const auto radius = static_cast<float>(bench.px(9.0));
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    int found = -1;
    for (std::size_t i = 0; i < facts.lights.size(); ++i) {
        const scene::Light light = withEdits(facts.lights[i], bench.document.edits);
        // An arrow's head has room beyond the ring.
        const std::optional<LightMarker> marker =
            markLight(view, lightHandle(light, facts.bounds), areaOf(frame), 2.2 * double(radius));
        if (!marker) continue;
        const ImVec2 place = windowPoint(marker->place);
        const bool isNear =
            isHovered && std::hypot(mouse.x - place.x, mouse.y - place.y) < 1.5f * radius;
        const bool isHeld = held == static_cast<int>(i);
        if (isNear && !marker->isBehind) found = static_cast<int>(i);
        if (isNear) tooltip(fmt::format("{} {}", light.name, describe(*marker)));
        const bool isSeen = marker->direction == glm::dvec2(0.0);
        if (isSeen && light.kind == scene::LightKind::directional)
            drawWayToMiddle(bench, frame, view, *marker);
        drawMarker(*marker, radius, isHeld || isNear ? kHeldColor : kLightColor, bench.scale);
        bench.map.area("light." + light.name, place.x - radius, place.y - radius, 2.0f * radius,
                       2.0f * radius,
                       isSeen             ? "seen"
                       : marker->isBehind ? "behind"
                                          : "outside");
    }
    return found;
}

void drawPhotons(const Bench& bench, const PictureFrame& frame) {
    const auto& probe = bench.result->probe;
    const ViewState& state = bench.view;
    // Of variant A only.
    if (!state.probes || state.probePixel.x < 0 || bench.requested().seen() != 0) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const glm::vec2 middle = glm::vec2(state.probePixel) + 0.5f;
    draw.AddCircle(frame.windowAt(middle), std::max(state.probeRadius * frame.zoom, 4.0f),
                   IM_COL32(255, 60, 60, 255), 0, 1.5f * bench.scale);
    if (!probe || probe->pixel != state.probePixel) return;
    const render::RasterView view = eyeViewOf(bench, frame);
    for (const PhotonPath& path : probe->paths) {
        for (std::size_t i = 1; i < path.points.size(); ++i) {
            const Projected from = project(view, path.points[i - 1]);
            const Projected to = project(view, path.points[i]);
            if (!from.visible || !to.visible) continue;
            // Before the first surface, on the way, and the last stretch to where it landed.
            const ImU32 color = i == 1                       ? IM_COL32(255, 220, 80, 60)
                                : i + 1 < path.points.size() ? IM_COL32(80, 200, 255, 110)
                                                             : IM_COL32(120, 255, 120, 110);
            draw.AddLine(frame.windowAt(from.pixel), frame.windowAt(to.pixel), color,
                         1.0f * bench.scale);
        }
    }
}

}  // namespace kaustik::gui
