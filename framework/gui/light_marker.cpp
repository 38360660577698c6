// SPDX-License-Identifier: MIT
#include "framework/gui/light_marker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaustik::gui {
namespace {

// Rays closer to the way straight back point nowhere.
constexpr double kMinSine = 1e-3;

// Where the way from the middle of an area in a direction meets its edge.
glm::dvec2 edgePoint(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& direction) {
    const glm::dvec2 half = 0.5 * (high - low);
    double way = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis) {
        if (direction[axis] != 0.0) way = std::min(way, half[axis] / std::abs(direction[axis]));
    }
    return 0.5 * (low + high) + way * direction;
}

}  // namespace

std::optional<LightMarker> markLight(const render::RasterView& view, const glm::dvec3& handleWs,
                                     const PictureArea& area, double margin) {
    const glm::dvec2 low = area.low + margin;
    const glm::dvec2 high = area.high - margin;
    if (!(low.x < high.x && low.y < high.y)) return std::nullopt;
    const glm::dvec3 handleVs(view.worldToView * glm::dvec4(handleWs, 1.0));
    LightMarker marker;
    marker.isBehind = !(-handleVs.z >= view.nearMeters);
    glm::dvec2 way(handleVs.x, -handleVs.y);
    if (!marker.isBehind) {
        const glm::dvec2 pixel = pixelOf(view, handleVs).value();
        const glm::dvec2 place =
            area.origin + area.zoom * glm::dvec2(pixel.x, view.height - pixel.y);
        const bool isSeen =
            place.x >= low.x && place.x <= high.x && place.y >= low.y && place.y <= high.y;
        if (isSeen) {
            marker.place = place;
            return marker;
        }
        way = place - 0.5 * (low + high);
    } else if (glm::length(way) < kMinSine * glm::length(handleVs)) {
        return std::nullopt;
    }
    marker.direction = glm::normalize(way);
    marker.place = edgePoint(low, high, marker.direction);
    return marker;
}

}  // namespace kaustik::gui
