// SPDX-License-Identifier: MIT
// A ray of every place in a cell: origin, direction and flux as functions of the place (jet.h),
// and which polygons of the cell take that way.
#pragma once

#include <array>
#include <cstdint>

#include "framework/certify/geometry.h"
#include "framework/certify/jet.h"
#include "framework/certify/polygon.h"

namespace kaustik::certify {

// Slopes, distances and areas that are larger than that are no enclosure to go on with.
inline constexpr double kHuge = 1e12;

template <bool s>
struct Beam {
    Vector<Jet<s>> at;           // local, m
    Vector<Jet<s>> along;        // unit
    std::array<Jet<s>, 3> flux;  // W per unit of the cell's area; the first one alone where
                                 // all are alike
};

// What is known of a place of the cell: over all of it, and at its middle.
struct Both {
    Jet<true> wide;
    Jet<false> middle;
    [[nodiscard]] TaylorModel model() const { return modelOf(middle, wide); }
};

struct Ray {
    Beam<true> wide;
    Beam<false> middle;
    std::array<Interval, 3> weight{Interval(1.0), Interval(1.0), Interval(1.0)};  // of channels
    std::uint32_t start = 0;                                                      // facet
    std::uint32_t medium = 0;  // material + 1; 0: none
    int interactions = 0;
    Polygons sure;  // what of the cell goes this way
    Polygons may;
};

template <bool s>
[[nodiscard]] Vector<Jet<s>> constant(const Vec& v) {
    return {Jet<s>(v.x), Jet<s>(v.y), Jet<s>(v.z)};
}
[[nodiscard]] inline Vec negated(const Vec& v) {
    return {-v.x, -v.y, -v.z};
}
[[nodiscard]] inline bool isFinite(const Vec& v) {
    return v.x.isFinite() && v.y.isFinite() && v.z.isFinite();
}

// Where model times sign is not negative.
[[nodiscard]] HalfPlane lineOf(const TaylorModel& model, double sign);
// The values of what is linear but for its rest, over polygons.
[[nodiscard]] Interval rangeOver(const TaylorModel& model, const Polygons& polygons);
// Origins and directions of the ray over polygons.
[[nodiscard]] Vec startOf(const Ray& ray, const Polygons& may);
[[nodiscard]] Vec alongOf(const Ray& ray, const Polygons& may);

// Along the beam to a facet's plane, m. Rays along the plane are for the caller to rule out.
template <bool s>
[[nodiscard]] Jet<s> distanceToPlane(const Beam<s>& beam, const Facet& facet) {
    const Vec a = exact(facet.position[0]);
    const Vector<Jet<s>> toPlane{a.x - beam.at.x, a.y - beam.at.y, a.z - beam.at.z};
    return dot(toPlane, constant<s>(facet.area)) *
           inverse(dot(beam.along, constant<s>(facet.area)));
}
// Whether the plane of a facet is crossed in the direction of `sign`, and at an angle that may be
// divided by.
[[nodiscard]] bool crossesPlane(const Ray& ray, const Facet& facet, double sign);
// Leaves of the flux what the medium lets through over the distance.
void absorb(const Geometry& geometry, const Both& distance, int channels, Ray& ray);

}  // namespace kaustik::certify
