// SPDX-License-Identifier: MIT
// Straight lines in the triangle's own coordinates, which are exact but for intervals' rounding: of
// a place p of the triangle, with e the way to the light, (A - p) x (B - p) . e tells on which side
// of the edge AB of a facet it passes, and N . (A - p) on which side of the facet p is. Both are
// linear in p, as p x p is 0; for a light at a point, too, whose e is its place less p.
#include "framework/certify/shadows.h"

#include <utility>

#include "framework/certify/ray.h"

namespace kaustik::certify {
namespace {

// Of the barycentrics of a triangle's second and third corner.
struct Linear {
    Interval value;
    Interval slopeX;
    Interval slopeY;
};

// Where it is positive, times `sign`; also after it has been put in a cell's coordinates (shade()).
HalfPlane lineOf(const Linear& f, double sign) {
    const double value = f.value.middle();
    const double slopeX = f.slopeX.middle();
    const double slopeY = f.slopeY.middle();
    const Interval unit(0.0, 1.0);
    const double rounded =
        0x1p-47 * (f.value.magnitude() + f.slopeX.magnitude() + f.slopeY.magnitude());
    const Interval rest = (f.value - Interval(value)) + (f.slopeX - Interval(slopeX)) * unit +
                          (f.slopeY - Interval(slopeY)) * unit + Interval(-rounded, rounded);
    const Interval signedRest = sign > 0.0 ? rest : -rest;
    return {sign * value, sign * slopeX, sign * slopeY, signedRest.lo, signedRest.hi};
}

class ShadowCaster {
  public:
    ShadowCaster(const Source& source, const Facet& triangle) : source_(source) {
        a_ = exact(triangle.position[0]);
        ab_ = exact(triangle.position[1]) - a_;
        ac_ = exact(triangle.position[2]) - a_;
        if (source.isDistant) toLight_ = negated(source.direction);
    }

    // Adds what the facet may shade, and what for sure.
    void add(const Facet& other, std::vector<Shadow>& shadows) const {
        const Interval closing =
            source_.isDistant ? dot(toLight_, other.area)
                              : dot(exact(source_.position) - exact(other.position[0]), other.area);
        for (const double along : {1.0, -1.0}) {
            if (along > 0.0 ? closing.hi < 0.0 : closing.lo > 0.0) continue;
            Shadow shadow;
            for (std::size_t i = 0; i < other.corners; ++i) {
                shadow.outer.push_back(lineOf(
                    edge(other.position[i], other.position[(i + 1) % other.corners]), along));
            }
            shadow.outer.push_back(lineOf(ahead(other), along));
            Polygon all = Polygon::cell();
            for (const HalfPlane& line : shadow.outer)
                all.cut(line, Side::outer);
            if (all.isEmpty()) continue;
            // On which side of the facet the light is must be sure.
            if (along > 0.0 ? closing.lo > 0.0 : closing.hi < 0.0) shadow.inner = shadow.outer;
            shadows.push_back(std::move(shadow));
        }
    }

  private:
    [[nodiscard]] Linear edge(const glm::dvec3& from, const glm::dvec3& to) const {
        if (source_.isDistant) {
            const Vec one = exact(from) - a_;
            const Vec two = exact(to) - a_;
            const Vec back = exact(from) - exact(to);
            return {dot(toLight_, cross(one, two)), dot(toLight_, cross(ab_, back)),
                    dot(toLight_, cross(ac_, back))};
        }
        const Vec light = exact(source_.position);
        const Vec normal = cross(exact(to) - light, exact(from) - light);
        return {dot(a_ - light, normal), dot(ab_, normal), dot(ac_, normal)};
    }
    [[nodiscard]] Linear ahead(const Facet& other) const {
        return {dot(exact(other.position[0]) - a_, other.area), -dot(ab_, other.area),
                -dot(ac_, other.area)};
    }

    const Source& source_;
    Vec a_;
    Vec ab_;
    Vec ac_;
    Vec toLight_;
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
    const ShadowCaster caster(source, own);
    std::vector<Shadow> shadows;
    geometry.sweep(start, velocity, end, [&](std::uint32_t g) {
        if (g != triangle && g != dropped) caster.add(geometry.facets()[g], shadows);
    });
    return shadows;
}

}  // namespace kaustik::certify
