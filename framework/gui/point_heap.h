// SPDX-License-Identifier: MIT
// Points of a chart that lie under the mouse together, and which of them a click takes.
#pragma once

#include <cstddef>
#include <vector>

namespace kaustik::gui {

struct PointOnChart {
    float x = 0.0f;  // px
    float y = 0.0f;
    bool isNow = false;  // what it stands for is at hand already
};

struct PointHeap {
    std::vector<std::size_t> points;  // in their order; none: a click takes nothing
    std::size_t next = 0;             // of these, the one that a click takes
};

// Those within `radius`, px. The next one is the nearest, or, where one of them is at hand, the one
// after it, so that clicks go through all of them.
[[nodiscard]] PointHeap heapAt(const std::vector<PointOnChart>& points, float x, float y,
                               float radius);

}  // namespace kaustik::gui
