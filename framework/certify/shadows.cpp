// SPDX-License-Identifier: MIT
// Straight lines in the triangle's own coordinates: the outline of each facet that the light's way
// to the triangle may meet, projected from the light onto the triangle's plane.
#include "framework/certify/shadows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/certify/eye_view.h"
#include "framework/certify/ray.h"

namespace kaustik::certify {
namespace {

class ShadowProjection {
  public:
    ShadowProjection(const Geometry& geometry, const Source& source, const Facet& triangle)
        : geometry_(geometry), source_(source), triangle_(triangle) {
        a_ = triangle.position[0];
        ab_ = triangle.position[1] - a_;
        ac_ = triangle.position[2] - a_;
        area_ = glm::cross(ab_, ac_);
        area2_ = glm::dot(area_, area_);
        if (source.isDistant) {
            const Vec back = negated(source.direction);
            from_ = a_ + glm::dvec3(back.x.middle(), back.y.middle(), back.z.middle()) *
                             (2.0 * geometry.size());
        } else {
            from_ = source.position;
        }
    }

    // Of what of the facet is before the triangle, all that may be or what is for sure. Empty:
    // nothing.
    [[nodiscard]] Region regionBehind(const Facet& other, Side side) const {
        const std::vector<glm::dvec3> corners =
            partBefore(other, triangle_, from_, geometry_.size(), side);
        if (corners.empty()) return {};
        std::vector<Point> outline;
        double reach = 1.0;
        bool isBehindLight = false;
        for (const glm::dvec3& p : corners) {
            const glm::dvec3 step = onPlane(p, isBehindLight) - a_;
            outline.push_back({glm::dot(glm::cross(step, ac_), area_) / area2_,
                               glm::dot(glm::cross(ab_, step), area_) / area2_});
            reach = std::max({reach, std::fabs(outline.back().x), std::fabs(outline.back().y)});
        }
        if (isBehindLight) {
            // All may be in shadow, and nothing is for sure.
            if (side == Side::outer) return {{1.0, 0.0, 0.0, 0.0, 0.0}};
            return {};
        }
        const double sideLength = std::sqrt(std::sqrt(area2_));
        const double hair = (kNear * geometry_.size() / sideLength + 1e-12) * reach;
        return regionOf(outline, hair);
    }

  private:
    // Where light by the point meets the triangle's plane.
    [[nodiscard]] glm::dvec3 onPlane(const glm::dvec3& p, bool& isBehindLight) const {
        if (source_.isDistant) {
            const glm::dvec3 along(source_.direction.x.middle(), source_.direction.y.middle(),
                                   source_.direction.z.middle());
            return p + glm::dot(a_ - p, area_) / glm::dot(along, area_) * along;
        }
        const glm::dvec3 along = p - source_.position;
        const double closing = glm::dot(along, area_);
        const double height = glm::dot(a_ - source_.position, area_);
        // Beyond the light it throws no shadow; near its height all of the plane.
        if (closing * height <= 1e-6 * height * height) isBehindLight = true;
        return source_.position + height / closing * along;
    }

    const Geometry& geometry_;
    const Source& source_;
    const Facet& triangle_;
    glm::dvec3 from_{0.0};
    glm::dvec3 a_{0.0};
    glm::dvec3 ab_{0.0};
    glm::dvec3 ac_{0.0};
    glm::dvec3 area_{0.0};
    double area2_ = 0.0;
};

}  // namespace

std::vector<Shadow> findShadows(const Geometry& geometry, const Source& source,
                                std::uint32_t triangle, std::uint32_t dropped) {
    const Facet& own = geometry.facets()[triangle];
    Box box;
    for (std::size_t i = 0; i < own.corners; ++i)
        box.include(own.position[i]);
    const Vec start{Interval(box.low.x, box.high.x), Interval(box.low.y, box.high.y),
                    Interval(box.low.z, box.high.z)};
    const Vec velocity =
        source.isDistant ? negated(source.direction) : exact(source.position) - start;
    const double end = source.isDistant ? 1e30 : 1.0;
    const ShadowProjection projection(geometry, source, own);
    std::vector<Shadow> shadows;
    // What is in front by a hair and no more is not looked at twice.
    geometry.sweep(start, velocity, end, [&](std::uint32_t g) {
        if (g == triangle || g == dropped) return;
        const Facet& other = geometry.facets()[g];
        Shadow shadow{projection.regionBehind(other, Side::outer),
                      projection.regionBehind(other, Side::inner)};
        if (shadow.outer.empty()) return;
        Polygon all = Polygon::cell();
        for (const HalfPlane& line : shadow.outer)
            all.cut(line, Side::outer);
        if (!all.isEmpty()) shadows.push_back(std::move(shadow));
    });
    return shadows;
}

}  // namespace kaustik::certify
