// SPDX-License-Identifier: MIT
#include "framework/certify/eye_view.h"

#include <algorithm>
#include <cmath>

#include "framework/render/view.h"

namespace kaustik::certify {
namespace {

// Of a pixel.
constexpr double kHair = 1e-9;
// Pixels with more facets than that are not looked into.
constexpr std::size_t kMaxFacets = 400;

double signedArea(const std::vector<Point>& corners) {
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        area += (corners[i].x - corners[0].x) * (corners[i + 1].y - corners[0].y) -
                (corners[i].y - corners[0].y) * (corners[i + 1].x - corners[0].x);
    }
    return 0.5 * area;
}

// Whether the eye is exactly in the plane of a facet along the axes.
bool isOnEdge(const Facet& facet, const glm::dvec3& eye) {
    for (int axis = 0; axis < 3; ++axis) {
        bool isFlat = true;
        for (std::size_t i = 0; i < facet.corners; ++i)
            isFlat = isFlat && facet.position[i][axis] == eye[axis];
        if (isFlat) return true;
    }
    return false;
}

double hairOf(const std::vector<Point>& corners) {
    double size = 0.0;
    for (const Point& p : corners)
        size = std::max({size, std::fabs(p.x), std::fabs(p.y)});
    return kHair + 1e-12 * size;
}

}  // namespace

Region regionOf(const std::vector<Point>& corners, double hair) {
    Region region;
    const double turn = signedArea(corners) >= 0.0 ? 1.0 : -1.0;
    double diameter = 0.0;
    for (const Point& p : corners) {
        diameter = std::max(
            {diameter, std::fabs(p.x - corners[0].x) * 2.0, std::fabs(p.y - corners[0].y) * 2.0});
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point& p = corners[i];
        const Point& q = corners[(i + 1) % corners.size()];
        const double length = std::hypot(q.x - p.x, q.y - p.y);
        HalfPlane line;
        if (!(length > 0.0)) continue;
        line.slopeX = -turn * (q.y - p.y) / length;
        line.slopeY = turn * (q.x - p.x) / length;
        line.value = -(line.slopeX * p.x + line.slopeY * p.y);
        // Whatever rounding has made of the line: outside of no corner, and inside of no point
        // that the true one would leave out.
        double lowest = 0.0;
        for (const Point& corner : corners)
            lowest = std::min(lowest, line.at(corner));
        line.high = -lowest + hair;
        line.low = -hair * (1.0 + 4.0 * diameter / length);
        region.push_back(line);
    }
    return region;
}

EyeView::EyeView(const Geometry& geometry, int width, int height) : width_(width), height_(height) {
    // As reference::Eye has it.
    const scene::Camera& camera = geometry.scene().camera;
    const render::RasterView view = render::makeEyeView(camera, width, height);
    const glm::dmat3 viewToWorld = glm::transpose(glm::dmat3(view.worldToView));
    right_ = viewToWorld[0];
    up_ = viewToWorld[1];
    backward_ = viewToWorld[2];
    position_ = camera.position - geometry.center();
    tangents_ = view.halfExtent;
    pixelsPerTangent_ = height / (2.0 * view.halfExtent.y);
    nearMeters_ = view.nearMeters;

    const std::vector<Facet>& facets = geometry.facets();
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    pixels_.resize(count);
    coverage_.assign(count, 0.0);
    extents_.resize(facets.size());
    std::vector<std::vector<Point>> outlines(facets.size());
    std::vector<std::vector<std::uint32_t>> seen(count);
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        const Facet& facet = facets[f];
        if (facet.kind == scene::MaterialKind::dielectric) continue;
        outlines[f] = project(
            {facet.position.begin(), facet.position.begin() + static_cast<long>(facet.corners)});
        if (outlines[f].empty()) continue;
        double left = 1e300;
        double right = -1e300;
        double top = 1e300;
        double bottom = -1e300;
        for (const Point& p : outlines[f]) {
            left = std::min(left, p.x);
            right = std::max(right, p.x);
            top = std::min(top, p.y);
            bottom = std::max(bottom, p.y);
        }
        const double hair = 4.0 * hairOf(outlines[f]);
        const auto cell = [](double at, int size) {
            return static_cast<int>(std::clamp(std::floor(at), -1.0, static_cast<double>(size)));
        };
        Extent& extent = extents_[f];
        extent = {std::max(cell(left - hair, width), 0),
                  std::min(cell(right + hair, width), width - 1),
                  std::max(cell(top - hair, height), 0),
                  std::min(cell(bottom + hair, height), height - 1)};
        const Region region = regionOf(outlines[f], hairOf(outlines[f]));
        for (int y = extent.top; y <= extent.bottom; ++y) {
            for (int x = extent.left; x <= extent.right; ++x) {
                // Apart where a side of the outline has all of the pixel beyond it.
                bool apart = false;
                for (const HalfPlane& line : region) {
                    const double highest = line.value +
                                           line.slopeX * (line.slopeX > 0.0 ? x + 1 : x) +
                                           line.slopeY * (line.slopeY > 0.0 ? y + 1 : y);
                    apart = apart || highest + line.high < 0.0;
                }
                if (!apart)
                    seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x)]
                        .push_back(f);
            }
        }
    }
    for (std::size_t pixel = 0; pixel < count; ++pixel)
        seePixel(geometry, pixel, seen[pixel], outlines);
}

// A pixel's corner is the ray r of depth 1. Where it meets the plane, depth |N·r| is the height,
// and a square metre covers pixels² height / depth³, of no depth before the near plane.
Interval coverageIn(const EyeView& eye, const Facet& facet, const Interval& height, int u, int v) {
    const Interval perLength = inverse(sqrt(dot(facet.area, facet.area)));
    const Vec unit = scaled(perLength, facet.area);
    const Interval perPixel = inverse(Interval(eye.pixelsPerTangent()));
    Interval slopes;
    for (int corner = 0; corner < 4; ++corner) {
        const Interval x = Interval(u + corner % 2) * perPixel - Interval(eye.tangents().x);
        const Interval y = Interval(eye.tangents().y) - Interval(v + corner / 2) * perPixel;
        const Vec ray =
            scaled(x, exact(eye.right())) + scaled(y, exact(eye.up())) - exact(eye.backward());
        const Interval slope = dot(unit, ray);
        slopes = corner == 0 ? slope : hull(slopes, slope);
    }
    if (slopes.hi <= 0.0) slopes = -slopes;
    const Interval slope(std::max(slopes.lo, 0.0), slopes.magnitude());
    const Interval perTangent2 = square(Interval(eye.pixelsPerTangent()));
    const Interval near(eye.nearMeters());
    const double nearest = (perTangent2 * height / (near * square(near))).hi;
    if (!staysAwayFromZero(square(height))) return {0.0, nearest};
    const Interval found = perTangent2 * (slope * square(slope)) / square(height);
    return {found.lo, std::min(found.hi, nearest)};
}

std::vector<Point> EyeView::project(const std::vector<glm::dvec3>& corners) const {
    // What is nearer than the near plane neither hides anything nor is seen.
    std::vector<glm::dvec3> before;
    const auto depthOf = [&](const glm::dvec3& p) { return -glm::dot(p - position_, backward_); };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& p = corners[i];
        const glm::dvec3& q = corners[(i + 1) % corners.size()];
        const double a = depthOf(p) - nearMeters_;
        const double b = depthOf(q) - nearMeters_;
        if (a >= 0.0) before.push_back(p);
        if ((a >= 0.0) != (b >= 0.0)) before.push_back(p + a / (a - b) * (q - p));
    }
    std::vector<Point> result;
    if (before.size() < 3) return result;
    for (const glm::dvec3& p : before) {
        const glm::dvec3 offset = p - position_;
        const double perDepth = 1.0 / std::max(depthOf(p), 0.5 * nearMeters_);
        result.push_back({(glm::dot(offset, right_) * perDepth + tangents_.x) * pixelsPerTangent_,
                          (tangents_.y - glm::dot(offset, up_) * perDepth) * pixelsPerTangent_});
    }
    return result;
}

void EyeView::seePixel(const Geometry& geometry, std::size_t pixel,
                       const std::vector<std::uint32_t>& facets,
                       const std::vector<std::vector<Point>>& outlines) {
    const std::vector<Facet>& all = geometry.facets();
    const double x = static_cast<double>(pixel % static_cast<std::size_t>(width_));
    const double y = static_cast<double>(pixel / static_cast<std::size_t>(width_));
    Polygon square;
    for (const Point& p : {Point{x, y}, Point{x + 1, y}, Point{x + 1, y + 1}, Point{x, y + 1}})
        square.add(p);
    double& coverage = coverage_[pixel];
    for (const std::uint32_t f : facets) {
        const Facet& facet = all[f];
        if (!facet.isReceiver()) continue;
        const double eyeHeight = std::fabs(glm::dot(facet.unit, position_ - facet.position[0]));
        // On edge there is nothing to see of it, and where that is not sure little.
        if (isOnEdge(facet, position_)) continue;
        const bool isNearlyOnEdge = eyeHeight < 1e-9 * geometry.size();
        if (isNearlyOnEdge) {
            const double nearMeters3 = nearMeters_ * nearMeters_ * nearMeters_;
            coverage = std::max(coverage, 1.000001 * (eyeHeight + 1e-9 * geometry.size()) /
                                              nearMeters3 * pixelsPerTangent_ * pixelsPerTangent_);
        }
        for (std::size_t corner = 0; corner < 4 && !isNearlyOnEdge; ++corner) {
            const glm::dvec3 ray = (square[corner].x / pixelsPerTangent_ - tangents_.x) * right_ +
                                   (tangents_.y - square[corner].y / pixelsPerTangent_) * up_ -
                                   backward_;
            const double slope = std::fabs(glm::dot(facet.unit, ray));
            coverage =
                std::max(coverage, 1.000001 * slope * slope * slope / (eyeHeight * eyeHeight) *
                                       pixelsPerTangent_ * pixelsPerTangent_);
        }
        const Region own = regionOf(outlines[f], hairOf(outlines[f]));
        for (const Side side : {Side::inner, Side::outer}) {
            if (isNearlyOnEdge && side == Side::inner) continue;
            Polygon start = square;
            bool isWhole = true;
            for (const HalfPlane& line : own) {
                const double shift = side == Side::inner ? line.low : line.high;
                for (std::size_t i = 0; i < square.size(); ++i)
                    isWhole = isWhole && line.at(square[i]) + shift >= 0.0;
                start.cut(line, side);
            }
            if (start.isEmpty()) continue;
            Polygons left{start};
            if (facets.size() <= kMaxFacets) {
                for (const std::uint32_t g : facets) {
                    if (g == f || left.empty()) continue;
                    // The more may hide it the less is sure.
                    const std::vector<Point> hides =
                        project(partBefore(all[g], facet, position_, geometry.size(),
                                           side == Side::inner ? Side::outer : Side::inner));
                    if (hides.size() < 3) continue;
                    if (subtract(left, regionOf(hides, hairOf(hides)),
                                 side == Side::inner ? Side::outer : Side::inner))
                        isWhole = false;
                }
            } else if (side == Side::inner) {
                continue;
            }
            for (const Polygon& polygon : left) {
                SeenPart part;
                part.facet = f;
                part.isWhole = isWhole;
                part.isSure = side == Side::inner;
                if (!isWhole) {
                    std::vector<Point> corners;
                    for (std::size_t i = 0; i < polygon.size(); ++i)
                        corners.push_back(polygon[i]);
                    part.edges = regionOf(corners, kHair);
                }
                pixels_[pixel].push_back(std::move(part));
            }
        }
    }
}

}  // namespace kaustik::certify
