// SPDX-License-Identifier: MIT
// Light that nothing is decided about: it counts above in all pixels where it may lie.
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/certify/cell_tracer.h"

namespace kaustik::certify {
namespace {

// Irradiance in a pixel, of the scene's, for whose sake no cell is split.
constexpr double kSmallOpen = 1e-5;

bool isEmpty(const EyeView::Extent& extent) {
    return extent.right < extent.left || extent.bottom < extent.top;
}

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

// The pixels in which points eye + offset are seen, of those in the extent.
EyeView::Extent project(const EyeView& eye, const Vec& offset, const EyeView::Extent& extent) {
    const Interval depth = -dot(offset, exact(eye.backward()));
    if (depth.hi < 0.5 * eye.nearMeters()) return {};
    if (!(depth.lo > 0.5 * eye.nearMeters())) return extent;
    const Interval ppt(eye.pixelsPerTangent());
    const Interval x = ppt * (dot(offset, exact(eye.right())) / depth + Interval(eye.tangents().x));
    const Interval y = ppt * (Interval(eye.tangents().y) - dot(offset, exact(eye.up())) / depth);
    if (!x.isFinite() || !y.isFinite()) return extent;
    const auto cell = [](double at, int low, int high) {
        return static_cast<int>(std::clamp(std::floor(at), low - 1.0, high + 1.0));
    };
    return {std::max(cell(x.lo, extent.left, extent.right), extent.left),
            std::min(cell(x.hi, extent.left, extent.right), extent.right),
            std::max(cell(y.lo, extent.top, extent.bottom), extent.top),
            std::min(cell(y.hi, extent.top, extent.bottom), extent.bottom)};
}

// The box around the facet, wider by a hair that is far above the rounding of its corners.
Vec boundsOf(const Facet& facet, double hair) {
    Box box;
    for (std::size_t i = 0; i < facet.corners; ++i)
        box.include(facet.position[i]);
    return {Interval(box.low.x - hair, box.high.x + hair),
            Interval(box.low.y - hair, box.high.y + hair),
            Interval(box.low.z - hair, box.high.z + hair)};
}

// The distances at which a coordinate start + distance along may be within bounds, of those given.
// Where `along` may be 0 nothing is told: the quotient has no bounds.
Interval distancesWithin(const Interval& start, const Interval& along, const Interval& bounds,
                         const Interval& distances) {
    if (!staysAwayFromZero(along)) return distances;
    const Interval found = (bounds - start) / along;
    return found.isFinite() ? intersection(distances, found) : distances;
}

// The pixels in which a facet is seen where rays from a box may meet it.
//
// A point that is met is p = s + t v with s and v in their boxes and t >= 0, it is on the facet's
// plane, and each coordinate is within the facet's bounds. So t is in N·(a - s) / N·v where N·v is
// not 0, and for each axis in (bounds - s) / v where v is not 0 on it; each of these intervals
// holds t whatever s and v are, and so does what they have in common. p is then in s + t v over
// these t as well as in the bounds, hence in both. Light that grazes the plane, whose N·v may be 0,
// is bounded by its axes alone. An empty intersection: no such p exists.
EyeView::Extent reach(const Geometry& geometry, const EyeView& eye, const Vec& start,
                      const Vec& along, std::uint32_t g) {
    const Facet& other = geometry.facets()[g];
    const EyeView::Extent& extent = eye.extent(g);
    const Vec bounds = boundsOf(other, kNear * geometry.size());
    Interval distance(0.0, std::numeric_limits<double>::infinity());
    const Interval closing = dot(along, other.area);
    if (staysAwayFromZero(closing)) {
        const Interval met = dot(exact(other.position[0]) - start, other.area) / closing;
        if (met.isFinite()) distance = intersection(distance, met);
    }
    distance = distancesWithin(start.x, along.x, bounds.x, distance);
    distance = distancesWithin(start.y, along.y, bounds.y, distance);
    distance = distancesWithin(start.z, along.z, bounds.z, distance);
    if (distance.lo > distance.hi) return {};
    if (!distance.isFinite()) return extent;
    const Vec swept = start + scaled(distance, along);
    if (!isFinite(swept)) return extent;
    const Vec hit{intersection(swept.x, bounds.x), intersection(swept.y, bounds.y),
                  intersection(swept.z, bounds.z)};
    if (hit.x.lo > hit.x.hi || hit.y.lo > hit.y.hi || hit.z.lo > hit.z.hi) return {};
    return project(eye, hit - exact(eye.position()), extent);
}

// Where light from the box may lie.
struct Reached {
    bool isAnywhere = false;
    std::vector<CellResult::Open> parts;
};

}  // namespace

bool CellTracer::giveUp(const Ray& ray, const Polygons& may, const std::vector<Vec>& directions) {
    const double area = rounding::up(areaOf(may)) + kAreaSlack;
    std::array<double, 3> watts;
    double largest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double bound = ray.wide.flux[channels_ == 1 ? 0 : c].value.hi;
        if (!std::isfinite(bound)) return false;
        watts[c] = rounding::up(rounding::up(std::max(bound, 0.0) * area) * ray.weight[c].hi);
        largest = std::max(largest, watts[c]);
    }
    const Vec start = startOf(ray, may);
    Reached reached{directions.empty() || !isFinite(start), {}};
    for (const Vec& along : directions) {
        if (!isFinite(along)) reached.isAnywhere = true;
        if (reached.isAnywhere) break;
        geometry_.sweep(start, along, 1e30, [&](std::uint32_t g) {
            if (g == ray.start || reached.isAnywhere) return;
            if (!facet(g).isReceiver()) {
                // Light that may meet another interaction may go anywhere from there.
                if (ray.interactions < tracer_.settings().interactions) reached.isAnywhere = true;
                return;
            }
            const EyeView::Extent extent = reach(geometry_, eye_, start, along, g);
            if (!isEmpty(extent)) reached.parts.push_back({g, extent, watts});
        });
    }
    if (!isFinal_) {
        // Light that is too little to see wherever it goes is not worth more cells.
        const double limit = kSmallOpen * tracer_.irradianceScale();
        if (reached.isAnywhere) return false;
        for (const CellResult::Open& open : reached.parts) {
            if (largest * coverageOf(eye_, open.extent) > limit) return false;
        }
    }
    const double mean = meanAbove(watts);
    found_.deposited = found_.deposited + Interval(0.0, mean);
    found_.lost = rounding::up(found_.lost + mean);
    if (reached.isAnywhere) {
        found_.undecided.push_back({watts});
    } else {
        found_.open.insert(found_.open.end(), reached.parts.begin(), reached.parts.end());
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
