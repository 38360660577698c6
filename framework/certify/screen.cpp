// SPDX-License-Identifier: MIT
#include "framework/certify/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaustik::certify {
namespace {

// c (o - e) and h d, whose sum is c times the place from the eye.
template <bool s>
struct Meeting {
    Vector<Jet<s>> fromEye;
    Vector<Jet<s>> along;
    Jet<s> closing;
    Jet<s> height;

    Meeting(const Beam<s>& beam, const Facet& goal, double side, const glm::dvec3& eye)
        : along(beam.along) {
        const Vec a = exact(goal.position[0]);
        const Vec normal = side > 0.0 ? goal.area : negated(goal.area);
        closing = dot(beam.along, normal);
        height = dot(Vector<Jet<s>>{a.x - beam.at.x, a.y - beam.at.y, a.z - beam.at.z}, normal);
        fromEye = {beam.at.x - Interval(eye.x), beam.at.y - Interval(eye.y),
                   beam.at.z - Interval(eye.z)};
    }
    [[nodiscard]] Jet<s> times(const Vec& axis) const {
        return dot(fromEye, axis) * closing + dot(along, axis) * height;
    }
};

// Depth, and what gives columns and rows from a point of the screen when divided by it.
Vec depthAxis(const EyeView& eye) {
    return negated(exact(eye.backward()));
}
Vec columnAxis(const EyeView& eye, double from) {
    const Interval ppt(eye.pixelsPerTangent());
    const Interval shift = ppt * Interval(eye.tangents().x) - Interval(from);
    return scaled(ppt, exact(eye.right())) + scaled(shift, depthAxis(eye));
}
Vec rowAxis(const EyeView& eye, double from) {
    const Interval ppt(eye.pixelsPerTangent());
    const Interval shift = ppt * Interval(eye.tangents().y) - Interval(from);
    return scaled(shift, depthAxis(eye)) - scaled(ppt, exact(eye.up()));
}

double sizeOf(const TaylorModel& model) {
    return std::fabs(model.value) + std::fabs(model.slope[0]) + std::fabs(model.slope[1]) +
           model.rest.magnitude();
}

Point centroidOf(const Polygons& polygons) {
    Polygon::Moments sum;
    for (const Polygon& polygon : polygons) {
        const Polygon::Moments m = polygon.moments();
        sum.area += m.area;
        sum.x += m.x;
        sum.y += m.y;
    }
    if (!(sum.area > 0.0)) return {1.0 / 3.0, 1.0 / 3.0};
    return {sum.x / sum.area, sum.y / sum.area};
}

// About what it is at a place of the cell.
double about(const Jet<false>& jet, const Point& p) {
    return jet.value.middle() + jet.gradient[0].middle() * (p.x - 1.0 / 3.0) +
           jet.gradient[1].middle() * (p.y - 1.0 / 3.0);
}

}  // namespace

Screen::Screen(const EyeView& eye, const Ray& ray, const Facet& goal, double along,
               const Polygons& may) {
    const Meeting<false> middle(ray.middle, goal, along, eye.position());
    const Meeting<true> wide(ray.wide, goal, along, eye.position());
    const Jet<false> depth = middle.times(depthAxis(eye));
    const Point center = centroidOf(may);
    const double depthThere = about(depth, center);
    // Any point does; the nearer to the image the better.
    const auto pointOn = [&](const Vec& axis, int size) {
        const double at = about(middle.times(axis), center) / depthThere;
        return std::isfinite(at) ? std::clamp(at, 0.0, static_cast<double>(size)) : 0.5 * size;
    };
    columnMiddle_ = pointOn(columnAxis(eye, 0.0), eye.width());
    rowMiddle_ = pointOn(rowAxis(eye, 0.0), eye.height());
    const Vec columns = columnAxis(eye, columnMiddle_);
    const Vec rows = rowAxis(eye, rowMiddle_);
    depth_ = modelOf(depth, wide.times(depthAxis(eye)));
    column_ = modelOf(middle.times(columns), wide.times(columns));
    row_ = modelOf(middle.times(rows), wide.times(rows));
    if (isFinite()) depthRange_ = rangeOver(depth_, may);
}

HalfPlane Screen::edge(double slopeX, double slopeY, double value, double low, double high) const {
    const Interval offset = Interval(value) + Interval(slopeX) * Interval(columnMiddle_) +
                            Interval(slopeY) * Interval(rowMiddle_) + Interval(low, high);
    const double middle = offset.middle();
    const Interval depths(0.0, std::max(depthRange_.hi, 0.0));
    const Interval rest = Interval(slopeX) * column_.rest + Interval(slopeY) * row_.rest +
                          Interval(middle) * depth_.rest + (offset - Interval(middle)) * depths;
    const auto sum = [&](double column, double row, double depth) {
        return slopeX * column + slopeY * row + middle * depth;
    };
    const double rounded =
        0x1p-47 * (std::fabs(slopeX) * sizeOf(column_) + std::fabs(slopeY) * sizeOf(row_) +
                   std::fabs(middle) * sizeOf(depth_) + rest.magnitude());
    return {sum(column_.value, row_.value, depth_.value),
            sum(column_.slope[0], row_.slope[0], depth_.slope[0]),
            sum(column_.slope[1], row_.slope[1], depth_.slope[1]), rest.lo - rounded,
            rest.hi + rounded};
}

double Screen::band(const EyeView::Extent& pixels) const {
    const auto along = [&](const TaylorModel& model, double from, int first, int last) {
        const double far = std::max(std::fabs(first - from), std::fabs(last + 1 - from));
        return (model.rest.width() + far * depth_.rest.width()) / depthRange_.lo;
    };
    return std::max(along(column_, columnMiddle_, pixels.left, pixels.right),
                    along(row_, rowMiddle_, pixels.top, pixels.bottom));
}

// A quotient of what is linear has its ends in corners.
EyeView::Extent Screen::pixelsIn(const Polygons& polygons, const EyeView::Extent& extent) const {
    Interval columns(std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity());
    Interval rows = columns;
    const auto at = [](const TaylorModel& model, const Point& p) {
        // Corners may be off by their rounding.
        const double slack = 1e-14 * (std::fabs(model.slope[0]) + std::fabs(model.slope[1]));
        return Interval(model.at(p.x, p.y)) + model.rest + Interval(-slack, slack);
    };
    const auto include = [](Interval& range, const Interval& value) {
        range = {std::min(range.lo, value.lo), std::max(range.hi, value.hi)};
    };
    for (const Polygon& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Interval depth = at(depth_, polygon[i]);
            if (!(depth.lo > kSmallestDivisor)) return extent;
            const Interval column = Interval(columnMiddle_) + at(column_, polygon[i]) / depth;
            const Interval row = Interval(rowMiddle_) + at(row_, polygon[i]) / depth;
            if (!column.isFinite() || !row.isFinite()) return extent;
            include(columns, column);
            include(rows, row);
        }
    }
    if (columns.hi < extent.left || columns.lo > extent.right + 1 || rows.hi < extent.top ||
        rows.lo > extent.bottom + 1)
        return {};
    return {static_cast<int>(std::max<double>(std::floor(columns.lo), extent.left)),
            static_cast<int>(std::min<double>(std::floor(columns.hi), extent.right)),
            static_cast<int>(std::max<double>(std::floor(rows.lo), extent.top)),
            static_cast<int>(std::min<double>(std::floor(rows.hi), extent.bottom))};
}

}  // namespace kaustik::certify
