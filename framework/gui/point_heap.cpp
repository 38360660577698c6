// SPDX-License-Identifier: MIT
#include "framework/gui/point_heap.h"

#include <cfloat>
#include <cmath>
#include <optional>

namespace kaustik::gui {

PointHeap heapAt(const std::vector<PointOnChart>& points, float x, float y, float radius) {
    PointHeap heap;
    std::optional<std::size_t> now;
    float nearest = FLT_MAX;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float distance = std::hypot(points[i].x - x, points[i].y - y);
        if (distance > radius) continue;
        if (points[i].isNow) now = heap.points.size();
        if (distance < nearest) {
            nearest = distance;
            heap.next = heap.points.size();
        }
        heap.points.push_back(i);
    }
    if (now) heap.next = (*now + 1) % heap.points.size();
    return heap;
}

}  // namespace kaustik::gui
