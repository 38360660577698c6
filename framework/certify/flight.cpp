// SPDX-License-Identifier: MIT
// The way from a surface to the next facets: to receivers, to another interaction, or out.
#include <array>

#include "framework/certify/cell_tracer.h"
#include "framework/certify/integration.h"

namespace kaustik::certify {
namespace {

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
    const std::vector<Candidate> candidates =
        findCandidates(geometry_, ray, start, velocity, tracer_.planted().droppedFacet);
    for (const Candidate& target : candidates) {
        const Visible visible = visiblePart(geometry_, ray, candidates, target);
        if (!visible.may.empty() && !advanceTo(ray, target, visible)) return false;
    }
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
    const Both distance{distanceToPlane(ray.wide, goal), distanceToPlane(ray.middle, goal)};
    Both b;
    Both c;
    arriveAt(goal, distance.wide, ray.wide, next.wide, b.wide, c.wide);
    arriveAt(goal, distance.middle, ray.middle, next.middle, b.middle, c.middle);
    absorb(geometry_, distance, channels_, next);
    return interact(*this, next, target.facet, target.along < 0.0, b, c);
}

}  // namespace kaustik::certify
