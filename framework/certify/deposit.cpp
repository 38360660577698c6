// SPDX-License-Identifier: MIT
// Light that meets a receiver, as irradiance of the pixels that see it there.
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/certify/cell_tracer.h"
#include "framework/certify/integration.h"

namespace kaustik::certify {
namespace {

// Irradiance in a pixel, of the scene's, for whose sake no cell is split.
constexpr double kSmallIrradiance = 1e-5;
// A cell that may reach more pixels than that is split.
constexpr long kManyPixels = 20000;

// Where the cell's light is seen: pixels from the left and from the top, and depth, m.
struct Screen {
    Both column;
    Both row;
    Both depth;
};

// Column and row are left 0 where the depth may be 0.
template <bool s>
void project(const EyeView& eye, const Beam<s>& beam, const Jet<s>& distance, Jet<s>& column,
             Jet<s>& row, Jet<s>& depth) {
    const glm::dvec3 eyeAt = eye.position();
    const Vector<Jet<s>> hit = beam.at + scaled(distance, beam.along);
    const Vector<Jet<s>> offset{hit.x - Interval(eyeAt.x), hit.y - Interval(eyeAt.y),
                                hit.z - Interval(eyeAt.z)};
    depth = -dot(offset, constant<s>(exact(eye.backward())));
    if (!staysAwayFromZero(depth.value)) return;
    const Jet<s> perDepth = inverse(depth);
    const Interval ppt(eye.pixelsPerTangent());
    column = ppt *
             (dot(offset, constant<s>(exact(eye.right()))) * perDepth + Interval(eye.tangents().x));
    row = ppt * (Interval(eye.tangents().y) - dot(offset, constant<s>(exact(eye.up()))) * perDepth);
}

// The irradiance that a pixel has of the cell's light, per unit of the cell's area: flux times the
// share of a pixel that a square metre covers, |N̂·(p - eye)| / depth³ times pixels.
template <bool s>
Jet<s> densityOf(const Interval& fixed, const Jet<s>& flux, const Jet<s>& depth) {
    const Jet<s> perDepth = inverse(depth);
    return fixed * (flux * (perDepth * square(perDepth)));
}

// The densities of channels, with their largest value, and how wide they are to it.
struct Density {
    std::array<TaylorModel, 3> channels;
    double largest = 0.0;
    double relativeWidth = 0.0;
};

// Nothing where there are no bounds. `eyeHeight`: N·(eye - p), where N is the facet's area.
std::optional<Density> densityOn(const EyeView& eye, const Facet& goal, const Interval& eyeHeight,
                                 const Ray& arriving, const Both& depth, int channels) {
    const Interval areaLength =
        sqrt(square(goal.area.x) + square(goal.area.y) + square(goal.area.z));
    Interval height = eyeHeight / areaLength;
    if (height.hi <= 0.0) height = -height;
    height = intersection(height, Interval(0.0, 1e30));
    const Interval fixed = height * square(Interval(eye.pixelsPerTangent()));
    Density density;
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
        density.channels[k] = modelOf(densityOf(fixed, arriving.middle.flux[k], depth.middle),
                                      densityOf(fixed, arriving.wide.flux[k], depth.wide));
        if (!density.channels[k].isFinite()) return std::nullopt;
        const double largest = std::max(density.channels[k].range().hi, 0.0);
        density.largest = std::max(density.largest, largest * arriving.weight[k].hi);
        density.relativeWidth = std::max(
            density.relativeWidth, density.channels[k].rest.width() / std::max(largest, 1e-300));
    }
    return density;
}

// Lines on the screen as lines in the cell.
class ScreenLines {
  public:
    ScreenLines(const TaylorModel& x, const TaylorModel& y) : x_(x), y_(y) {}

    // What of the cell is seen in that part of the pixel at column u and row v.
    void find(const SeenPart& part, int u, int v, std::vector<HalfPlane>& lines) const {
        lines.clear();
        if (part.isWhole) {
            lines.push_back(lineFor(1.0, 0.0, -u, 0.0, 0.0));
            lines.push_back(lineFor(-1.0, 0.0, u + 1.0, 0.0, 0.0));
            lines.push_back(lineFor(0.0, 1.0, -v, 0.0, 0.0));
            lines.push_back(lineFor(0.0, -1.0, v + 1.0, 0.0, 0.0));
            return;
        }
        for (const HalfPlane& edge : part.edges)
            lines.push_back(lineFor(edge.slopeX, edge.slopeY, edge.value, edge.low, edge.high));
    }

  private:
    [[nodiscard]] HalfPlane lineFor(double slopeX, double slopeY, double value, double low,
                                    double high) const {
        const Interval rest =
            Interval(slopeX) * x_.rest + Interval(slopeY) * y_.rest + Interval(low, high);
        const double rounded =
            1e-14 * (std::fabs(value) + std::fabs(x_.value) + std::fabs(y_.value));
        return HalfPlane{value + slopeX * x_.value + slopeY * y_.value,
                         slopeX * x_.slope[0] + slopeY * y_.slope[0],
                         slopeX * x_.slope[1] + slopeY * y_.slope[1], rest.lo - rounded,
                         rest.hi + rounded};
    }

    const TaylorModel& x_;
    const TaylorModel& y_;
};

// Adds the integral of the density over what of the polygons the lines keep; whether anything is.
bool addIntegral(const Polygons& polygons, const std::vector<HalfPlane>& lines,
                 const Density& density, int channels, bool isSure, std::array<Interval, 3>& sum) {
    bool any = false;
    for (Polygon polygon : polygons) {
        for (const HalfPlane& line : lines)
            polygon.cut(line, isSure ? Side::inner : Side::outer);
        if (polygon.isEmpty()) continue;
        any = true;
        for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
            const double value =
                std::max(integralBound(density.channels[k], polygon, !isSure), 0.0);
            double& bound = isSure ? sum[k].lo : sum[k].hi;
            bound = isSure ? rounding::down(bound + value) : rounding::up(bound + value);
        }
    }
    return any;
}

Colors weighted(const std::array<Interval, 3>& sum, const std::array<Interval, 3>& weight,
                int channels) {
    Colors irradiance;
    for (std::size_t k = 0; k < 3; ++k) {
        const Interval& value = sum[channels == 1 ? 0 : k];
        irradiance[k] = {std::max(rounding::down(std::max(value.lo, 0.0) * weight[k].lo), 0.0),
                         rounding::up(std::max(value.hi, 0.0) * weight[k].hi)};
    }
    return irradiance;
}

// The pixels of the extent in which the ranges may lie; empty where none.
EyeView::Extent pixelsIn(const EyeView::Extent& extent, const Interval& x, const Interval& y) {
    if (x.hi < extent.left || x.lo > extent.right + 1 || y.hi < extent.top ||
        y.lo > extent.bottom + 1)
        return {};
    return {static_cast<int>(std::max<double>(std::floor(x.lo), extent.left)),
            static_cast<int>(std::min<double>(std::floor(x.hi), extent.right)),
            static_cast<int>(std::max<double>(std::floor(y.lo), extent.top)),
            static_cast<int>(std::min<double>(std::floor(y.hi), extent.bottom))};
}

// Adds the irradiance of the pixels that see the facet.
void depositIn(const EyeView& eye, const EyeView::Extent& pixels, std::uint32_t facet,
               const ScreenLines& screen, const Density& density, const Ray& arriving,
               const Visible& visible, int channels, std::vector<CellResult::Deposit>& deposits) {
    std::vector<HalfPlane> lines;
    for (int v = pixels.top; v <= pixels.bottom; ++v) {
        for (int u = pixels.left; u <= pixels.right; ++u) {
            const std::size_t pixel =
                static_cast<std::size_t>(v) * static_cast<std::size_t>(eye.width()) +
                static_cast<std::size_t>(u);
            std::array<Interval, 3> sum;
            bool any = false;
            for (const SeenPart& part : eye.parts(pixel)) {
                if (part.facet != facet) continue;
                screen.find(part, u, v, lines);
                const Polygons& polygons = part.isSure ? visible.sure : visible.may;
                if (addIntegral(polygons, lines, density, channels, part.isSure, sum)) any = true;
            }
            if (any) deposits.push_back({pixel, weighted(sum, arriving.weight, channels)});
        }
    }
}

}  // namespace

bool CellTracer::deposit(const Ray& ray, const Candidate& target, const Visible& visible) {
    const Facet& goal = facet(target.facet);
    const Polygons& may = visible.may;
    const auto giveUpHere = [&] { return giveUp(ray, may, {alongOf(ray, may)}); };
    if (!crossesPlane(ray, goal, target.along)) return giveUpHere();
    const Both distance{distanceToPlane(ray.wide, goal), distanceToPlane(ray.middle, goal)};
    if (!distance.model().isFinite() || !(distance.wide.value.magnitude() < kHuge))
        return giveUpHere();
    if (ray.medium != 0 && geometry_.absorbs() && !(distance.wide.value.lo > -1.0))
        return giveUpHere();
    Ray arriving = ray;
    absorb(geometry_, distance, channels_, arriving);
    const Interval watts = wattsOf(arriving, visible.sure, may, channels_);
    if (!watts.isFinite()) return giveUpHere();
    if (!isFinal_ && watts.width() > 1e-6 * tracer_.wattScale()) return false;
    const auto leaveUnseen = [&] {
        found_.deposited = found_.deposited + watts;
        return true;
    };
    const EyeView::Extent& extent = eye_.extent(target.facet);
    // The eye sees the side that the light arrives on.
    const Interval eyeHeight = dot(exact(eye_.position()) - exact(goal.position[0]), goal.area);
    const bool isSeen = target.along < 0.0 ? eyeHeight.hi > 0.0 : eyeHeight.lo < 0.0;
    if (extent.right < extent.left || extent.bottom < extent.top || !isSeen) return leaveUnseen();

    Screen screen;
    project(eye_, ray.wide, distance.wide, screen.column.wide, screen.row.wide, screen.depth.wide);
    project(eye_, ray.middle, distance.middle, screen.column.middle, screen.row.middle,
            screen.depth.middle);
    const TaylorModel depth = screen.depth.model();
    if (depth.isFinite() && rangeOver(depth, may).hi < eye_.nearMeters()) return leaveUnseen();
    if (!(screen.depth.wide.value.lo > 0.5 * eye_.nearMeters())) return giveUpHere();
    const TaylorModel x = screen.column.model();
    const TaylorModel y = screen.row.model();
    if (!x.isFinite() || !y.isFinite()) return giveUpHere();
    const EyeView::Extent pixels = pixelsIn(extent, rangeOver(x, may), rangeOver(y, may));
    if (pixels.right < pixels.left || pixels.bottom < pixels.top) return leaveUnseen();
    const long count = (pixels.right - pixels.left + 1L) * (pixels.bottom - pixels.top + 1L);
    if (!isFinal_ && count > kManyPixels) return false;

    const std::optional<Density> density =
        densityOn(eye_, goal, eyeHeight, arriving, screen.depth, channels_);
    if (!density) return giveUpHere();
    const double bandPixels = tracer_.settings().bandPixels;
    const bool isBright =
        density->largest * areaOf(may) > kSmallIrradiance * tracer_.irradianceScale();
    const bool isVague = std::max(x.rest.width(), y.rest.width()) > bandPixels ||
                         density->relativeWidth > 4.0 * bandPixels;
    if (!isFinal_ && isBright && isVague) return false;
    found_.deposited = found_.deposited + watts;
    depositIn(eye_, pixels, target.facet, ScreenLines(x, y), *density, arriving, visible, channels_,
              found_.deposits);
    return true;
}

}  // namespace kaustik::certify
