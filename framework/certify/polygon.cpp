// SPDX-License-Identifier: MIT
#include "framework/certify/polygon.h"

#include <algorithm>
#include <cmath>

#include "framework/core/error.h"

namespace kaustik::certify {

Polygon Polygon::cell() {
    Polygon result;
    result.add({0.0, 0.0});
    result.add({1.0, 0.0});
    result.add({0.0, 1.0});
    return result;
}

void Polygon::add(const Point& point) {
    if (count_ == kCapacity) throw Error("certify: a polygon has too many corners.", kExitFailed);
    points_[count_++] = point;
}

void Polygon::cut(const HalfPlane& line, Side side) {
    cut(line.value, line.slopeX, line.slopeY, side == Side::inner ? line.low : line.high);
}

void Polygon::cut(double value, double slopeX, double slopeY, double shift) {
    if (count_ == 0) return;
    const auto at = [&](const Point& p) { return value + slopeX * p.x + slopeY * p.y + shift; };
    std::array<double, kCapacity> heights;
    bool anyInside = false;
    bool anyOutside = false;
    for (std::size_t i = 0; i < count_; ++i) {
        heights[i] = at(points_[i]);
        (heights[i] >= 0.0 ? anyInside : anyOutside) = true;
    }
    if (!anyOutside) return;
    if (!anyInside) {
        count_ = 0;
        return;
    }
    const Polygon before = *this;
    count_ = 0;
    for (std::size_t i = 0; i < before.count_; ++i) {
        const std::size_t next = i + 1 == before.count_ ? 0 : i + 1;
        const double a = heights[i];
        const double b = heights[next];
        if (a >= 0.0) add(before[i]);
        if ((a >= 0.0) == (b >= 0.0)) continue;
        const double t = a / (a - b);
        const Point& p = before[i];
        const Point& q = before[next];
        add({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
    if (count_ < 3) count_ = 0;
}

Polygon::Moments Polygon::moments() const {
    Moments sum;
    if (count_ < 3) return sum;
    const Point& o = points_[0];
    for (std::size_t i = 1; i + 1 < count_; ++i) {
        const Point a{points_[i].x - o.x, points_[i].y - o.y};
        const Point b{points_[i + 1].x - o.x, points_[i + 1].y - o.y};
        const double part = 0.5 * (a.x * b.y - a.y * b.x);
        sum.area += part;
        sum.x += part * (a.x + b.x) / 3.0;
        sum.y += part * (a.y + b.y) / 3.0;
    }
    sum.x += sum.area * o.x;
    sum.y += sum.area * o.y;
    return sum;
}

bool subtract(Polygons& from, const Region& region, Side side) {
    if (region.empty()) return false;
    bool isTaken = false;
    Polygons kept;
    for (const Polygon& polygon : from) {
        Polygons pieces;
        Polygon within = polygon;
        for (const HalfPlane& line : region) {
            const double shift = side == Side::inner ? line.low : line.high;
            Polygon without = within;
            without.cut(-line.value, -line.slopeX, -line.slopeY, -shift);
            if (!without.isEmpty()) pieces.push_back(without);
            within.cut(line.value, line.slopeX, line.slopeY, shift);
            if (within.isEmpty()) break;
        }
        // What no region touches stays in one piece.
        if (within.isEmpty()) {
            kept.push_back(polygon);
        } else {
            isTaken = true;
            kept.insert(kept.end(), pieces.begin(), pieces.end());
        }
    }
    from = std::move(kept);
    return isTaken;
}

double areaOf(const Polygons& polygons) {
    double area = 0.0;
    for (const Polygon& polygon : polygons)
        area += polygon.moments().area;
    return area;
}

}  // namespace kaustik::certify
