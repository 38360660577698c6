// SPDX-License-Identifier: MIT
// The way from a surface to the next facets: to receivers, to another interaction, or out.
#include <algorithm>
#include <array>

#include "framework/certify/cell_tracer.h"
#include "framework/certify/integration.h"

namespace kaustik::certify {
namespace {

// From so many on light that ends at a surface is bounded for all of them together.
constexpr std::ptrdiff_t kManySurfaces = 4;

// Where on a triangle the ray arrives: the barycentrics of its second and third corner.
template <bool s>
void arriveAt(const Facet& goal, const Jet<s>& distance, const Beam<s>& beam, Beam<s>& onward,
              Jet<s>& b, Jet<s>& c) {
    const Vec a = exact(goal.position[0]);
    const Vec ab = exact(goal.position[1]) - a;
    const Vec ac = exact(goal.position[2]) - a;
    const Interval perArea2 =
        inverse(square(goal.area.x) + square(goal.area.y) + square(goal.area.z));
    const Vec alongB = scaled(perArea2, cross(ac, goal.area));
    const Vec alongC = scaled(perArea2, cross(goal.area, ab));
    onward.at = beam.at + scaled(distance, beam.along);
    const Vector<Jet<s>> step{onward.at.x - a.x, onward.at.y - a.y, onward.at.z - a.z};
    b = dot(step, constant<s>(alongB));
    c = dot(step, constant<s>(alongC));
}

}  // namespace

bool CellTracer::advance(const Ray& ray) {
    const std::array<TaylorModel, 6> models{modelOf(ray.middle.at.x, ray.wide.at.x),
                                            modelOf(ray.middle.at.y, ray.wide.at.y),
                                            modelOf(ray.middle.at.z, ray.wide.at.z),
                                            modelOf(ray.middle.along.x, ray.wide.along.x),
                                            modelOf(ray.middle.along.y, ray.wide.along.y),
                                            modelOf(ray.middle.along.z, ray.wide.along.z)};
    std::array<Interval, 6> ranges;
    for (std::size_t i = 0; i < 6; ++i) {
        if (!models[i].isFinite()) return giveUp(ray, ray.may, {});
        ranges[i] = rangeOver(models[i], ray.may);
        if (!(ranges[i].magnitude() < kHuge)) return giveUp(ray, ray.may, {});
    }
    const Vec start{ranges[0], ranges[1], ranges[2]};
    const Vec velocity{ranges[3], ranges[4], ranges[5]};
    if (isLimited(ray, start, velocity)) {
        found_.limited = found_.limited + wattsOf(ray, ray.sure, ray.may, channels_);
        return true;
    }
    const std::vector<Candidate> candidates =
        findCandidates(geometry_, ray, start, velocity, tracer_.planted().droppedFacet);
    if (candidates.size() > kManyCandidates) return giveUp(ray, ray.may, {velocity});
    // Which of many surfaces light meets that ends there is not worth to be known.
    const bool isLast = ray.interactions >= tracer_.settings().interactions;
    const auto endsAt = [&](const Candidate& target) {
        return isLast && !facet(target.facet).isReceiver();
    };
    const bool endsAtMany =
        std::count_if(candidates.begin(), candidates.end(), endsAt) > kManySurfaces;
    if (endsAtMany) {
        found_.limited =
            found_.limited + Interval(0.0, wattsOf(ray, ray.sure, ray.may, channels_).hi);
    }
    for (const Candidate& target : candidates) {
        if (endsAtMany && endsAt(target)) continue;
        const Visible visible = visiblePart(geometry_, ray, candidates, target);
        if (!visible.may.empty() && !advanceTo(ray, target, visible)) return false;
    }
    return true;
}

bool CellTracer::isLimited(const Ray& ray, const Vec& start, const Vec& velocity) const {
    if (ray.interactions < tracer_.settings().interactions || ray.medium == 0 ||
        !facet(ray.start).isClosed)
        return false;
    bool mayMeetReceiver = false;
    geometry_.sweep(start, velocity, 1e30, [&](std::uint32_t g) {
        mayMeetReceiver = mayMeetReceiver || facet(g).isReceiver();
    });
    return !mayMeetReceiver;
}

bool CellTracer::endsInBody(const Ray& ray, const std::vector<Vec>& directions) {
    const Vec start = startOf(ray, ray.may);
    for (const Vec& along : directions) {
        if (!isLimited(ray, start, along)) return false;
    }
    found_.limited = found_.limited + wattsOf(ray, ray.sure, ray.may, channels_);
    return true;
}

bool CellTracer::advanceTo(const Ray& ray, const Candidate& target, const Visible& visible) {
    const Facet& goal = facet(target.facet);
    if (goal.isReceiver()) return deposit(ray, target, visible);
    if (ray.interactions >= tracer_.settings().interactions) {
        found_.limited = found_.limited + wattsOf(ray, visible.sure, visible.may, channels_);
        return true;
    }
    // On to the next interaction.
    if (!crossesPlane(ray, goal, target.along))
        return giveUp(ray, visible.may, {alongOf(ray, visible.may)});
    Ray next = ray;
    next.sure = visible.sure;
    next.may = visible.may;
    Both distance{distanceToPlane(ray.wide, goal), distanceToPlane(ray.middle, goal)};
    narrow(distance.middle, distance.wide);
    Both b;
    Both c;
    arriveAt(goal, distance.wide, ray.wide, next.wide, b.wide, c.wide);
    arriveAt(goal, distance.middle, ray.middle, next.middle, b.middle, c.middle);
    narrow(next.middle.at, next.wide.at);
    narrow(b.middle, b.wide);
    narrow(c.middle, c.wide);
    absorb(geometry_, distance, channels_, next);
    return interact(*this, next, target.facet, target.along < 0.0, b, c);
}

}  // namespace kaustik::certify
