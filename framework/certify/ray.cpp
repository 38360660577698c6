// SPDX-License-Identifier: MIT
#include "framework/certify/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaustik::certify {

HalfPlane lineOf(const TaylorModel& model, double sign) {
    const Interval rest = sign > 0.0 ? model.rest : -model.rest;
    // What the sum with the rest is rounded by; all else is in the rest (jet.cpp).
    const double rounded = 0x1p-50 * rest.magnitude();
    return {sign * model.value, sign * model.slope[0], sign * model.slope[1], rest.lo - rounded,
            rest.hi + rounded};
}

Interval rangeOver(const TaylorModel& model, const Polygons& polygons) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Polygon& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const double value = model.at(polygon[i].x, polygon[i].y);
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    // Corners may be off by their rounding.
    const double slack = 1e-14 * (std::fabs(model.slope[0]) + std::fabs(model.slope[1]));
    return Interval(low - slack, high + slack) + model.rest;
}

Vec startOf(const Ray& ray, const Polygons& may) {
    return {rangeOver(modelOf(ray.middle.at.x, ray.wide.at.x), may),
            rangeOver(modelOf(ray.middle.at.y, ray.wide.at.y), may),
            rangeOver(modelOf(ray.middle.at.z, ray.wide.at.z), may)};
}

Vec alongOf(const Ray& ray, const Polygons& may) {
    return {rangeOver(modelOf(ray.middle.along.x, ray.wide.along.x), may),
            rangeOver(modelOf(ray.middle.along.y, ray.wide.along.y), may),
            rangeOver(modelOf(ray.middle.along.z, ray.wide.along.z), may)};
}

bool crossesPlane(const Ray& ray, const Facet& facet, double sign) {
    const Interval closing = dot(ray.wide.along, constant<true>(facet.area)).value;
    return sign > 0.0 ? closing.lo > kSmallestDivisor : closing.hi < -kSmallestDivisor;
}

void absorb(const Geometry& geometry, const Both& distance, int channels, Ray& ray) {
    if (ray.medium == 0 || !geometry.absorbs()) return;
    const scene::Material& filling = geometry.scene().materials[ray.medium - 1];
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
        const Interval perMeter(
            static_cast<double>(filling.absorptionPerMeter[static_cast<int>(k)]));
        ray.wide.flux[k] = ray.wide.flux[k] * exp(-perMeter * distance.wide);
        ray.middle.flux[k] = ray.middle.flux[k] * exp(-perMeter * distance.middle);
    }
}

}  // namespace kaustik::certify
