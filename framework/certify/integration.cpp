// SPDX-License-Identifier: MIT
#include "framework/certify/integration.h"

#include <algorithm>
#include <cmath>

namespace kaustik::certify {
namespace {

// Of what is not negative.
Interval integral(const TaylorModel& model, const Polygons& sure, const Polygons& may) {
    double low = 0.0;
    for (const Polygon& polygon : sure)
        low += std::max(integralBound(model, polygon, false), 0.0);
    double high = 0.0;
    for (const Polygon& polygon : may)
        high += std::max(integralBound(model, polygon, true), 0.0);
    return {rounding::down(low * (1.0 - 1e-15)), rounding::up(high * (1.0 + 1e-15))};
}

}  // namespace

double integralBound(const TaylorModel& model, const Polygon& polygon, bool isUpper) {
    const Polygon::Moments m = polygon.moments();
    const double linear = model.value * m.area + model.slope[0] * m.x + model.slope[1] * m.y;
    const bool isCell = m.area >= 0.5;
    const Interval& rest = isCell ? model.restMean : model.rest;
    const double size = std::fabs(model.value) + std::fabs(model.slope[0]) +
                        std::fabs(model.slope[1]) + rest.magnitude();
    return isUpper ? linear + std::fabs(m.area) * rest.hi + size * kAreaSlack
                   : linear + std::fabs(m.area) * rest.lo - size * kAreaSlack;
}

Interval wattsOf(const Ray& ray, const Polygons& sure, const Polygons& may, int channels) {
    Interval sum(0.0);
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = channels == 1 ? 0 : c;
        const TaylorModel model = modelOf(ray.middle.flux[k], ray.wide.flux[k]);
        sum = sum + ray.weight[c] * integral(model, sure, may);
    }
    return sum / Interval(3.0);
}

}  // namespace kaustik::certify
