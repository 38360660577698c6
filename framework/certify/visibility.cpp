// SPDX-License-Identifier: MIT
#include "framework/certify/visibility.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace kaustik::certify {
namespace {

// Polygons of a cell that are cut further.
constexpr std::size_t kManyPieces = 256;

CellExtent extentOf(const Polygons& polygons) {
    constexpr double kHair = 1e-9;
    CellExtent extent;
    for (const Polygon& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            extent.low.x = std::min(extent.low.x, polygon[i].x - kHair);
            extent.low.y = std::min(extent.low.y, polygon[i].y - kHair);
            extent.high.x = std::max(extent.high.x, polygon[i].x + kHair);
            extent.high.y = std::max(extent.high.y, polygon[i].y + kHair);
        }
    }
    return extent;
}
bool overlap(const CellExtent& a, const CellExtent& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

// Where the ray meets the plane within the corners: polynomials of origin and direction, so that
// rays along the plane are no trouble. `slack`: by which the corners may be off, m. Nothing where
// it surely does not.
Region hitRegion(const Ray& ray, const std::vector<glm::dvec3>& corners, const Facet& plane,
                 double along, double slack) {
    Region region;
    const Interval off(-slack, slack);
    const auto fromOrigin = [&](const auto& beam, const glm::dvec3& p) {
        using J = std::decay_t<decltype(beam.at.x)>;
        return Vector<J>{(Interval(p.x) + off) - beam.at.x, (Interval(p.y) + off) - beam.at.y,
                         (Interval(p.z) + off) - beam.at.z};
    };
    std::vector<Vector<Jet<true>>> wide;
    std::vector<Vector<Jet<false>>> middle;
    for (const glm::dvec3& p : corners) {
        wide.push_back(fromOrigin(ray.wide, p));
        middle.push_back(fromOrigin(ray.middle, p));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t j = (i + 1) % corners.size();
        const TaylorModel model = modelOf(dot(ray.middle.along, cross(middle[i], middle[j])),
                                          dot(ray.wide.along, cross(wide[i], wide[j])));
        region.push_back(lineOf(model, along));
    }
    // In front of the origin.
    const TaylorModel ahead = modelOf(dot(middle[0], constant<false>(plane.area)),
                                      dot(wide[0], constant<true>(plane.area)));
    region.push_back(lineOf(ahead, along));
    const Jet<true> closing = dot(ray.wide.along, constant<true>(plane.area));
    if (!(along > 0.0 ? closing.value.lo > 0.0 : closing.value.hi < 0.0)) {
        region.push_back(
            lineOf(modelOf(dot(ray.middle.along, constant<false>(plane.area)), closing), along));
    }
    return region;
}

std::vector<glm::dvec3> cornersOf(const Facet& facet) {
    return {facet.position.begin(), facet.position.begin() + static_cast<long>(facet.corners)};
}

// By the side rule of the reference: whether light that moves `along` the normal meets the surface.
bool isMetFrom(const Facet& facet, double along, std::uint32_t medium) {
    const bool leaves = along > 0.0;
    if (facet.kind == scene::MaterialKind::dielectric)
        return leaves == (medium == facet.material + 1);
    return !(facet.kind == scene::MaterialKind::mirror && facet.isClosed && leaves);
}

// Whether both have an edge that they go along in opposite directions. What decides on which side
// of it a ray passes is then one function with two signs, so that no ray meets both but for the
// edge itself: neither hides the other, and nothing at the edge is lost twice.
bool shareEdge(const Facet& a, const Facet& b) {
    for (std::size_t i = 0; i < a.corners; ++i) {
        const glm::dvec3& p = a.position[i];
        const glm::dvec3& q = a.position[(i + 1) % a.corners];
        for (std::size_t j = 0; j < b.corners; ++j) {
            if (b.position[j] == q && b.position[(j + 1) % b.corners] == p) return true;
        }
    }
    return false;
}

// Whether no ray that starts on the facet meets the other from that side, as all of the facet is on
// the other side of its plane or in it: the neighbours of a convex surface's triangle, from
// outside.
bool isBeyond(const Facet& from, const Facet& other, double along) {
    for (std::size_t i = 0; i < from.corners; ++i) {
        const glm::dvec3& p = from.position[i];
        const auto end = other.position.begin() + static_cast<long>(other.corners);
        if (std::find(other.position.begin(), end, p) != end) continue;
        const Interval ahead = dot(exact(other.position[0]) - exact(p), other.area);
        if (along > 0.0 ? ahead.hi > 0.0 : ahead.lo < 0.0) return false;
    }
    return true;
}

// Whether rays from the box in directions of the box all pass outside of one edge, or lie on the
// other side of the plane.
bool surelyMisses(const Facet& facet, const std::vector<glm::dvec3>& corners, double along,
                  const Vec& start, const Vec& velocity) {
    const Interval closing = dot(velocity, facet.area);
    const Interval ahead = dot(exact(facet.position[0]) - start, facet.area);
    if (along > 0.0 ? closing.hi <= 0.0 || ahead.hi < 0.0 : closing.lo >= 0.0 || ahead.lo > 0.0)
        return true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Interval edge =
            dot(velocity,
                cross(exact(corners[i]) - start, exact(corners[(i + 1) % corners.size()]) - start));
        if (along > 0.0 ? edge.hi < 0.0 : edge.lo > 0.0) return true;
    }
    return false;
}

}  // namespace

std::vector<Candidate> findCandidates(const Geometry& geometry, const Ray& ray, const Vec& start,
                                      const Vec& velocity, std::uint32_t dropped) {
    std::vector<Candidate> candidates;
    geometry.sweep(start, velocity, 1e30, [&](std::uint32_t g) {
        if (g == ray.start || g == dropped || candidates.size() > kManyCandidates) return;
        const Facet& other = geometry.facets()[g];
        const std::vector<glm::dvec3> corners = cornersOf(other);
        for (const double along : {1.0, -1.0}) {
            if (!isMetFrom(other, along, ray.medium) ||
                isBeyond(geometry.facets()[ray.start], other, along) ||
                surelyMisses(other, corners, along, start, velocity))
                continue;
            Candidate candidate;
            candidate.facet = g;
            candidate.along = along;
            candidate.region = hitRegion(ray, corners, other, along, 0.0);
            for (Polygon polygon : ray.may) {
                for (const HalfPlane& line : candidate.region)
                    polygon.cut(line, Side::outer);
                if (!polygon.isEmpty()) candidate.may.push_back(polygon);
            }
            candidate.extent = extentOf(candidate.may);
            if (!candidate.may.empty()) candidates.push_back(std::move(candidate));
        }
    });
    return candidates;
}

Visible visiblePart(const Geometry& geometry, const Ray& ray,
                    const std::vector<Candidate>& candidates, const Candidate& target) {
    const double slack = 1e-13 * geometry.size();
    const Facet& goal = geometry.facets()[target.facet];
    Visible visible{{}, target.may};
    for (Polygon polygon : ray.sure) {
        for (const HalfPlane& line : target.region)
            polygon.cut(line, Side::inner);
        if (!polygon.isEmpty()) visible.sure.push_back(polygon);
    }
    const glm::dvec3 from = goal.position[0] - target.along * goal.unit;
    for (const Candidate& other : candidates) {
        if (other.facet == target.facet || !overlap(other.extent, target.extent)) continue;
        const Facet& blocker = geometry.facets()[other.facet];
        if (other.along == target.along && shareEdge(goal, blocker)) continue;
        for (const Side side : {Side::outer, Side::inner}) {
            Polygons& left = side == Side::outer ? visible.sure : visible.may;
            if (left.empty()) continue;
            // Of so many pieces nothing is sure any more, and nothing is taken away.
            if (left.size() > kManyPieces) {
                if (side == Side::outer) left.clear();
                continue;
            }
            const std::vector<glm::dvec3> corners =
                partBefore(blocker, goal, from, geometry.size(), side);
            if (corners.empty()) continue;
            const bool isAll = corners.size() == blocker.corners &&
                               std::equal(corners.begin(), corners.end(), blocker.position.begin());
            subtract(left,
                     isAll ? other.region : hitRegion(ray, corners, blocker, other.along, slack),
                     side);
        }
    }
    return visible;
}

}  // namespace kaustik::certify
