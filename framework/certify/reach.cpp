// SPDX-License-Identifier: MIT
#include "framework/certify/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/certify/ray.h"

namespace kaustik::certify {
namespace {

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

// A point that is met is p = s + t v with s and v in their boxes and t >= 0, it is on the facet's
// plane, and each coordinate is within the facet's bounds. So t is in N·(a - s) / N·v where N·v is
// not 0, and for each axis in (bounds - s) / v where v is not 0 on it; each of these intervals
// holds t whatever s and v are, and so does what they have in common. p is then in s + t v over
// these t as well as in the bounds, hence in both. Light that grazes the plane, whose N·v may be 0,
// is bounded by its axes alone. An empty intersection: no such p exists.
std::optional<Vec> boxMet(const Geometry& geometry, const Vec& start, const Vec& along,
                          const Facet& facet) {
    const Vec bounds = boundsOf(facet, kNear * geometry.size());
    Interval distance(0.0, std::numeric_limits<double>::infinity());
    const Interval closing = dot(along, facet.area);
    if (staysAwayFromZero(closing)) {
        const Interval met = dot(exact(facet.position[0]) - start, facet.area) / closing;
        if (met.isFinite()) distance = intersection(distance, met);
    }
    distance = distancesWithin(start.x, along.x, bounds.x, distance);
    distance = distancesWithin(start.y, along.y, bounds.y, distance);
    distance = distancesWithin(start.z, along.z, bounds.z, distance);
    if (distance.lo > distance.hi) return std::nullopt;
    if (!distance.isFinite()) return bounds;
    const Vec swept = start + scaled(distance, along);
    if (!isFinite(swept)) return bounds;
    const Vec hit{intersection(swept.x, bounds.x), intersection(swept.y, bounds.y),
                  intersection(swept.z, bounds.z)};
    if (hit.x.lo > hit.x.hi || hit.y.lo > hit.y.hi || hit.z.lo > hit.z.hi) return std::nullopt;
    return hit;
}

// Boxes of unit normals on the side where `side` is 1: interpolated ones, and the triangle's own.
// Nothing where there are no bounds.
std::vector<Vec> normalsOf(const Facet& facet, double side) {
    Vec box = exact(side * facet.normal[0]);
    for (std::size_t i = 1; i < 3; ++i) {
        const Vec n = exact(side * facet.normal[i]);
        box = {hull(box.x, n.x), hull(box.y, n.y), hull(box.z, n.z)};
    }
    const Interval length2 = square(box.x) + square(box.y) + square(box.z);
    if (!(length2.lo > 1e-20)) return {};
    const Vec own = side > 0.0 ? facet.area : negated(facet.area);
    // The reference moves an interpolated normal that is on the other side of its triangle.
    if (!(dot(box, own).lo > 0.0)) return {};
    return {scaled(inverse(sqrt(length2)), box), scaled(inverse(sqrt(dot(own, own))), own)};
}

class Follower {
  public:
    Follower(const Geometry& geometry, const EyeView& eye, Reached& reached)
        : geometry_(geometry), eye_(eye), reached_(reached) {}

    void follow(const Vec& start, const Vec& along, std::uint32_t from, int interactions) {
        if (!isFinite(start) || !isFinite(along)) reached_.isAnywhere = true;
        if (reached_.isAnywhere) return;
        std::vector<std::uint32_t> met;
        geometry_.sweep(start, along, 1e30, [&](std::uint32_t g) {
            if (g != from) met.push_back(g);
        });
        for (const std::uint32_t g : met) {
            if (reached_.isAnywhere) return;
            const Facet& facet = geometry_.facets()[g];
            if (facet.isReceiver()) {
                add({g, pixelsReached(geometry_, eye_, start, along, g)});
            } else if (interactions > 0) {
                if (const std::optional<Vec> hit = boxMet(geometry_, start, along, facet))
                    goOn(*hit, along, g, interactions - 1);
            } else {
                reached_.isLimited = true;
            }
        }
    }

  private:
    void goOn(const Vec& hit, const Vec& along, std::uint32_t at, int interactions) {
        // Light that may meet so many surfaces is no more worth to be followed.
        if (++steps_ > 200) reached_.isAnywhere = true;
        const Facet& facet = geometry_.facets()[at];
        const scene::Material& material = geometry_.scene().materials[facet.material];
        const bool isMirror = facet.kind == scene::MaterialKind::mirror;
        const Interval closing = dot(along, facet.area);
        for (const double side : {1.0, -1.0}) {
            // From the front, or from the back.
            if (side > 0.0 ? closing.lo > 0.0 : closing.hi < 0.0) continue;
            const Interval inside(static_cast<double>(material.ior));
            const Interval eta = side > 0.0 ? Interval(1.0) / inside : inside;
            const std::vector<Vec> normals = normalsOf(facet, side);
            if (normals.empty()) reached_.isAnywhere = true;
            std::vector<Vec> directions;
            for (const Vec& normal : normals)
                addDirections(along, normal, eta, isMirror, directions);
            for (const Vec& direction : directions)
                follow(hit, direction, at, interactions);
        }
    }

    void add(const Reached::Part& part) {
        const EyeView::Extent& e = part.extent;
        if (e.right < e.left || e.bottom < e.top) return;
        for (Reached::Part& other : reached_.parts) {
            EyeView::Extent& o = other.extent;
            if (other.facet != part.facet || e.left > o.right || o.left > e.right ||
                e.top > o.bottom || o.top > e.bottom)
                continue;
            o = {std::min(o.left, e.left), std::max(o.right, e.right), std::min(o.top, e.top),
                 std::max(o.bottom, e.bottom)};
            return;
        }
        reached_.parts.push_back(part);
    }

    const Geometry& geometry_;
    const EyeView& eye_;
    Reached& reached_;
    int steps_ = 0;
};

}  // namespace

EyeView::Extent pixelsReached(const Geometry& geometry, const EyeView& eye, const Vec& start,
                              const Vec& along, std::uint32_t facet) {
    const std::optional<Vec> hit = boxMet(geometry, start, along, geometry.facets()[facet]);
    if (!hit) return {};
    return project(eye, *hit - exact(eye.position()), eye.extent(facet));
}

void addDirections(const Vec& along, const Vec& normal, const Interval& eta, bool isMirror,
                   std::vector<Vec>& directions) {
    Interval cosine = -dot(along, normal);
    if (cosine.hi < 0.0) return;
    cosine.lo = std::max(cosine.lo, 0.0);
    directions.push_back(along + scaled(Interval(2.0) * cosine, normal));
    if (isMirror) return;
    Interval root = Interval(1.0) - square(eta) * (Interval(1.0) - square(cosine));
    if (root.hi < 0.0) return;
    root.lo = std::max(root.lo, 0.0);
    directions.push_back(scaled(eta, along) + scaled(eta * cosine - sqrt(root), normal));
}

void follow(const Geometry& geometry, const EyeView& eye, const Vec& start, const Vec& along,
            std::uint32_t from, int interactions, Reached& reached) {
    Follower(geometry, eye, reached).follow(start, along, from, interactions);
}

}  // namespace kaustik::certify
