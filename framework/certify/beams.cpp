// SPDX-License-Identifier: MIT
#include "framework/certify/beams.h"

#include <algorithm>
#include <cmath>

#include "framework/certify/cell_tracer.h"

namespace kaustik::certify {
namespace {

// What a triangle has of a light at most, m² or sr: half of |closing|, which is N·d, or N·(a - p)
// over the cube of the least distance; of all directions no more than half.
double shareAbove(const Source& source, const Facet& facet, const Interval& closing) {
    const double half = rounding::up(0.5 * closing.magnitude());
    if (source.isDistant) return half;
    Box box;
    for (std::size_t i = 0; i < facet.corners; ++i)
        box.include(facet.position[i]);
    const glm::dvec3& p = source.position;
    const Interval distance2 = square(Interval(box.low.x, box.high.x) - Interval(p.x)) +
                               square(Interval(box.low.y, box.high.y) - Interval(p.y)) +
                               square(Interval(box.low.z, box.high.z) - Interval(p.z));
    constexpr double kHalfSphere = 6.2831853071795872;
    if (!staysAwayFromZero(distance2)) return kHalfSphere;
    const Interval share = Interval(half) * inverse(distance2 * sqrt(distance2));
    return std::min(share.hi, kHalfSphere);
}

}  // namespace

BeamTracer::BeamTracer(const Geometry& geometry, const EyeView& eye, const BeamSettings& settings,
                       const PlantedError& planted)
    : geometry_(geometry), eye_(eye), settings_(settings), planted_(planted) {
    for (const Source& source : geometry.sources()) {
        const double power = std::max({source.power.r, source.power.g, source.power.b});
        double watts = 0.0;
        double brightest = source.isDistant ? power : 0.0;
        for (const Facet& facet : geometry.facets()) {
            if (facet.isReceiver()) continue;
            const glm::dvec3 area(facet.area.x.middle(), facet.area.y.middle(),
                                  facet.area.z.middle());
            if (source.isDistant) {
                const glm::dvec3 along(source.direction.x.middle(), source.direction.y.middle(),
                                       source.direction.z.middle());
                watts += 0.25 * power * std::fabs(glm::dot(area, along));
            } else {
                const glm::dvec3 away = facet.position[0] - source.position;
                const double distance = std::max(glm::length(away), 1e-3 * geometry.size());
                watts += 0.25 * power * std::fabs(glm::dot(area, away)) /
                         (distance * distance * distance);
                brightest = std::max(brightest, power / (distance * distance));
            }
        }
        wattScale_ += watts;
        irradianceScale_ = std::max(irradianceScale_, brightest);
    }
    std::vector<Box> boxes(geometry.scene().objects.size());
    for (const Facet& facet : geometry.facets()) {
        for (std::size_t i = 0; i < facet.corners; ++i)
            boxes[facet.object].include(facet.position[i]);
    }
    for (const Source& source : geometry.sources()) {
        std::vector<bool>& outside = isOutside_.emplace_back();
        for (const Box& box : boxes) {
            outside.push_back(source.isDistant ||
                              glm::any(glm::lessThan(source.position, box.low)) ||
                              glm::any(glm::greaterThan(source.position, box.high)));
        }
    }
}

std::uint64_t BeamTracer::pieces() const {
    return geometry_.sources().size() * geometry_.facets().size();
}

BoundSums BeamTracer::emptySums() const {
    return BoundSums(
        static_cast<std::size_t>(eye_.width()) * static_cast<std::size_t>(eye_.height()),
        geometry_.facets().size() + 1, irradianceScale_, wattScale_);
}

void BeamTracer::trace(std::uint64_t piece, BoundSums& sums) const {
    const std::size_t facets = geometry_.facets().size();
    const auto first = static_cast<std::uint32_t>(piece % facets);
    const Source& source = geometry_.sources()[piece / facets];
    const Facet& facet = geometry_.facets()[first];
    if (facet.isReceiver() || first == planted_.droppedFacet) return;
    const Vec a = exact(facet.position[0]);
    Interval closing = source.isDistant ? dot(source.direction, facet.area)
                                        : dot(a - exact(source.position), facet.area);
    if (closing.lo == 0.0 && closing.hi == 0.0) return;
    // The back of a closed surface has a front before it, for light from outside.
    const bool isBack = closing.lo > 0.0;
    if (isBack && facet.isClosed && isOutside_[piece / facets][facet.object]) return;
    std::array<Interval, 3> power;
    for (std::size_t c = 0; c < 3; ++c)
        power[c] = Interval(static_cast<double>(source.power[static_cast<int>(c)]));
    if (!(closing.lo > 0.0 || closing.hi < 0.0)) {
        // Edge on, within rounding.
        const double sent = shareAbove(source, facet, closing);
        std::array<double, 3> watts;
        for (std::size_t c = 0; c < 3; ++c)
            watts[c] = rounding::up(sent * power[c].hi);
        sums.addEmitted({0.0, meanAbove(watts)});
        sums.addDeposited({0.0, meanAbove(watts)});
        sums.addUndecided(facets, watts);
        return;
    }
    CellTracer(*this, source, first, power, sums).trace();
}

}  // namespace kaustik::certify
