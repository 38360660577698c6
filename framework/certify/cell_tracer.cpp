// SPDX-License-Identifier: MIT
#include "framework/certify/cell_tracer.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "framework/certify/integration.h"
#include "framework/core/error.h"

namespace kaustik::certify {
namespace {

// A cell of so much of the light, of all of it, is not split for what it leaves open.
constexpr double kSmallShare = 1e-9;
// The same with more than one interaction, where more is left open.
constexpr double kSmallShareBentTwice = 1e-11;

// A coordinate of the cell's places in the triangle.
Both barycentric(const Cell& cell, std::size_t axis) {
    Both place;
    const Interval corner(cell.corner[axis]);
    const Interval x(cell.sides[0][axis]);
    const Interval y(cell.sides[1][axis]);
    place.wide.value = corner + x * Interval(0.0, 1.0) + y * Interval(0.0, 1.0);
    place.wide.gradient = {x, y};
    place.middle.value = corner + (x + y) / Interval(3.0);
    place.middle.gradient = {x, y};
    return place;
}

// Light that arrives from the source at a place of the triangle. `scale`: the cell's area of the
// triangle's.
template <bool s>
Beam<s> arrivalOf(const Source& source, const Facet& own, bool enters, const Interval& scale,
                  const Jet<s>& u, const Jet<s>& v) {
    const Vec a = exact(own.position[0]);
    const Vec ab = exact(own.position[1]) - a;
    const Vec ac = exact(own.position[2]) - a;
    Beam<s> beam;
    beam.at = {a.x + (ab.x * u + ac.x * v), a.y + (ab.y * u + ac.y * v),
               a.z + (ab.z * u + ac.z * v)};
    Jet<s> density;
    if (source.isDistant) {
        beam.along = constant<s>(source.direction);
        const Interval closing = dot(source.direction, own.area);
        density = Jet<s>(scale * (enters ? -closing : closing));
    } else {
        const Vector<Jet<s>> away{beam.at.x - Interval(source.position.x),
                                  beam.at.y - Interval(source.position.y),
                                  beam.at.z - Interval(source.position.z)};
        const Jet<s> perLength = inverse(sqrt(squaredLength(away)));
        beam.along = scaled(perLength, away);
        const Interval closing = dot(a - exact(source.position), own.area);
        density = (scale * (enters ? -closing : closing)) * (perLength * square(perLength));
    }
    beam.flux = {density, density, density};
    return beam;
}

// Whether the source's light meets the front.
bool entersFrom(const Source& source, const Facet& own) {
    if (source.isDistant) return dot(source.direction, own.area).hi < 0.0;
    return dot(exact(own.position[0]) - exact(source.position), own.area).hi < 0.0;
}

}  // namespace

void CellResult::clearWays() {
    deposits.clear();
    undecided.clear();
    open.clear();
    lost = 0.0;
    deposited = limited = Interval(0.0);
}

CellResult::Mark CellResult::mark() const {
    return {deposits.size(), undecided.size(), open.size(), lost, deposited, limited};
}

void CellResult::goBack(const Mark& mark) {
    deposits.resize(mark.deposits);
    undecided.resize(mark.undecided);
    open.resize(mark.open);
    lost = mark.lost;
    deposited = mark.deposited;
    limited = mark.limited;
}

void CellResult::clear() {
    clearWays();
    emitted = Interval(0.0);
}

CellTracer::CellTracer(const BeamTracer& tracer, const Source& source, std::uint32_t first,
                       const std::array<Interval, 3>& power, BoundSums& sums)
    : tracer_(tracer),
      geometry_(tracer.geometry()),
      eye_(tracer.eye()),
      source_(source),
      first_(first),
      sums_(sums),
      channels_(geometry_.absorbs() ? 3 : 1),
      power_(power),
      shadows_(findShadows(geometry_, source, first, tracer.planted().droppedFacet)) {}

void CellTracer::trace() {
    split({{0.0, 0.0}, {std::array<double, 2>{1.0, 0.0}, std::array<double, 2>{0.0, 1.0}}, 0, 0});
}

void CellTracer::split(const Cell& cell) {
    if (traceCell(cell)) {
        send();
        return;
    }
    // What has been found by now is of the branches that are done; that there is a cell, and its
    // light, its parts will tell.
    found_.emitted = Interval(0.0);
    sendFound();
    const unsigned followed = followed_;
    if (cell.depth > tracer_.settings().maxDepth + 8)
        throw Error("certify: a cell has no bounds at all; this is an error of the program.",
                    kExitFailed);
    const auto& x = cell.sides[0];
    const auto& y = cell.sides[1];
    const auto at = [&](double u, double v) {
        return std::array<double, 2>{cell.corner[0] + u * x[0] + v * y[0],
                                     cell.corner[1] + u * x[1] + v * y[1]};
    };
    const std::array<double, 2> halfX{0.5 * x[0], 0.5 * x[1]};
    const std::array<double, 2> halfY{0.5 * y[0], 0.5 * y[1]};
    const int depth = cell.depth + 1;
    split({at(0.0, 0.0), {halfX, halfY}, depth, followed});
    split({at(0.5, 0.0), {halfX, halfY}, depth, followed});
    split({at(0.0, 0.5), {halfX, halfY}, depth, followed});
    split(
        {at(0.5, 0.5),
         {std::array<double, 2>{-halfX[0], -halfX[1]}, std::array<double, 2>{-halfY[0], -halfY[1]}},
         depth,
         followed});
}

void CellTracer::shade(const Cell& cell, Ray& ray) const {
    const auto inCell = [&](const Region& region) {
        Region result;
        for (const HalfPlane& line : region) {
            result.push_back(
                {line.value + line.slopeX * cell.corner[0] + line.slopeY * cell.corner[1],
                 line.slopeX * cell.sides[0][0] + line.slopeY * cell.sides[0][1],
                 line.slopeX * cell.sides[1][0] + line.slopeY * cell.sides[1][1], line.low,
                 line.high});
        }
        return result;
    };
    for (const Shadow& shadow : shadows_) {
        subtract(ray.sure, inCell(shadow.outer), Side::outer);
        subtract(ray.may, inCell(shadow.inner), Side::inner);
    }
}

bool CellTracer::traceCell(const Cell& cell) {
    found_.clear();
    followed_ = cell.followed;
    isLeftToParts_ = false;
    const Facet& own = facet(first_);
    Ray ray;
    ray.start = first_;
    ray.sure = ray.may = {Polygon::cell()};
    shade(cell, ray);
    if (ray.may.empty()) return true;

    const Both b = barycentric(cell, 0);
    const Both c = barycentric(cell, 1);
    const Interval scale(std::ldexp(1.0, -2 * cell.depth));
    const bool enters = entersFrom(source_, own);
    ray.wide = arrivalOf(source_, own, enters, scale, b.wide, c.wide);
    ray.middle = arrivalOf(source_, own, enters, scale, b.middle, c.middle);
    ray.weight = power_;
    const Interval& density = ray.wide.flux[0].value;
    if (!density.isFinite() || !(density.hi < kHuge * tracer_.wattScale())) return false;
    found_.emitted = wattsOf(ray, ray.sure, ray.may, channels_);
    const double smallShare =
        tracer_.settings().interactions > 1 ? kSmallShareBentTwice : kSmallShare;
    isFinal_ = cell.depth >= tracer_.settings().maxDepth ||
               found_.emitted.hi <= smallShare * tracer_.wattScale();
    // On the border of a shadow.
    if (!isFinal_ && found_.emitted.width() > 1e-7 * tracer_.wattScale()) return false;
    // Light whose first surface is a dielectric's back comes from within it.
    const bool isWithin = !enters && own.kind == scene::MaterialKind::dielectric;
    if (isWithin) ray.medium = own.material + 1;
    const bool isDimmed = isWithin && !source_.isDistant && geometry_.absorbs();
    const bool done =
        isDimmed ? giveUp(ray, ray.may, {}) : interact(*this, ray, first_, enters, b, c);
    // No light gains watts.
    found_.deposited.hi = std::min(found_.deposited.hi, found_.emitted.hi);
    found_.limited.hi = std::min(found_.limited.hi, found_.emitted.hi);
    if ((done && !isLeftToParts_) || !isFinal_) return done && !isLeftToParts_;
    // Not even bounds of what goes which way: it is all given up.
    found_.clearWays();
    return giveUp(ray, ray.may, {});
}

bool CellTracer::advanceBranch(const Ray& ray, Branch branch) {
    if (ray.interactions > 1) return advance(ray);
    if ((followed_ & branch) != 0) return true;
    const CellResult::Mark mark = found_.mark();
    if (advance(ray)) {
        followed_ |= branch;
    } else {
        found_.goBack(mark);
        isLeftToParts_ = true;
    }
    return true;
}

bool CellTracer::giveUpBranches(const Ray& ray, const Polygons& may,
                                const std::vector<Vec>& directions, unsigned branches) {
    if (ray.interactions > 1) return giveUp(ray, may, directions);
    if ((followed_ & branches) == branches) return true;
    if (!giveUp(ray, may, directions)) return false;
    followed_ |= branches;
    return true;
}

void CellTracer::send() const {
    sums_.countCells(1);
    sums_.addEmitted(found_.emitted);
    sendFound();
}

void CellTracer::sendFound() const {
    sums_.addDeposited(found_.deposited);
    sums_.addLimited(found_.limited);
    for (const CellResult::Deposit& add : found_.deposits)
        sums_.addPixel(add.pixel, add.irradiance);
    for (const CellResult::Lost& lost : found_.undecided)
        sums_.addUndecided(geometry_.facets().size(), lost.watts);
    for (const CellResult::Open& open : found_.open)
        sendOpen(open);
    sums_.addLost(found_.lost);
}

}  // namespace kaustik::certify
