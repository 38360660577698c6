// SPDX-License-Identifier: MIT
// Light that nothing is decided about: it counts above in all pixels where it may lie.
#include <algorithm>
#include <cmath>

#include "framework/certify/cell_tracer.h"
#include "framework/certify/reach.h"

namespace kaustik::certify {
namespace {

// Irradiance in a pixel, of the scene's, for whose sake no cell is split; with more than one
// interaction, where many cells are near the critical angle and reach the same pixels.
constexpr double kSmallOpen = 1e-5;
constexpr double kSmallOpenBentTwice = 1e-8;

std::size_t pixelAt(const EyeView& eye, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.width()) +
           static_cast<std::size_t>(x);
}

// The largest coverage in the extent's corners, 1/m²: about what it is in its pixels.
double coverageOf(const EyeView& eye, const EyeView::Extent& extent) {
    double largest = 0.0;
    for (const int y : {extent.top, extent.bottom}) {
        for (const int x : {extent.left, extent.right})
            largest = std::max(largest, eye.maxCoverage(pixelAt(eye, x, y)));
    }
    return largest;
}

}  // namespace

bool CellTracer::giveUp(const Ray& ray, const Polygons& may, const std::vector<Vec>& directions) {
    const double area = areaOf(may) + kAreaSlack * static_cast<double>(1 + may.size());
    std::array<double, 3> watts;
    double largest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double bound = ray.wide.flux[channels_ == 1 ? 0 : c].value.hi;
        if (!std::isfinite(bound)) return false;
        watts[c] = rounding::up(rounding::up(std::max(bound, 0.0) * area) * ray.weight[c].hi);
        largest = std::max(largest, watts[c]);
    }
    const Vec start = startOf(ray, may);
    Reached reached;
    reached.isAnywhere = directions.empty();
    for (const Vec& along : directions) {
        follow(geometry_, eye_, start, along, ray.start,
               tracer_.settings().interactions - ray.interactions, reached);
    }
    if (!isFinal_) {
        // Light that is too little to see wherever it goes is not worth more cells.
        const double limit =
            (tracer_.settings().interactions > 1 ? kSmallOpenBentTwice : kSmallOpen) *
            tracer_.irradianceScale();
        if (reached.isAnywhere) return false;
        for (const Reached::Part& part : reached.parts) {
            if (largest * coverageOf(eye_, part.extent) > limit) return false;
        }
    }
    const double mean = meanAbove(watts);
    found_.deposited = found_.deposited + Interval(0.0, mean);
    found_.lost = rounding::up(found_.lost + mean);
    if (reached.isAnywhere || reached.isLimited)
        found_.limited = found_.limited + Interval(0.0, mean);
    if (reached.isAnywhere) {
        found_.undecided.push_back({watts});
    } else {
        for (const Reached::Part& part : reached.parts)
            found_.open.push_back({part.facet, part.extent, watts});
    }
    return true;
}

void CellTracer::sendOpen(const CellResult::Open& open) const {
    for (int y = open.extent.top; y <= open.extent.bottom; ++y) {
        for (int x = open.extent.left; x <= open.extent.right; ++x) {
            const std::size_t pixel = pixelAt(eye_, x, y);
            for (const SeenPart& seen : eye_.parts(pixel)) {
                if (seen.facet != open.facet) continue;
                std::array<double, 3> irradiance;
                for (std::size_t c = 0; c < 3; ++c)
                    irradiance[c] = rounding::up(open.watts[c] * eye_.maxCoverage(pixel));
                sums_.addOpen(pixel, irradiance);
                break;
            }
        }
    }
}

}  // namespace kaustik::certify
