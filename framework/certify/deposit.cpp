// SPDX-License-Identifier: MIT
// Light that meets a receiver, as irradiance of the pixels that see it there.
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/certify/cell_tracer.h"
#include "framework/certify/integration.h"
#include "framework/certify/reach.h"
#include "framework/certify/screen.h"

namespace kaustik::certify {
namespace {

// Irradiance in all pixels of a cell, of the scene's, for whose sake it is not split.
constexpr double kSmallIrradiance = 1e-5;
// Between the bounds of all pixels of a cell that grazes its receiver, of the scene's irradiance.
constexpr double kSmallWidth = 1e-6;
// A cell that may reach more pixels than that is split.
constexpr long kManyPixels = 20000;
// From so many pixels on it is worth to look twice at which they are.
constexpr long kSomePixels = 16;
// Of a cell's light, between its bounds; after two interactions, when the edges of triangles that
// bend it the second time are known only up to a band.
constexpr double kSmallWatts = 2e-4;
constexpr double kSmallWattsBentTwice = 4e-3;
// Of a cell's light, what is deposited of it at most; above it bounds are far from what they bound.
constexpr double kMaxGain = 1.5;

// The flux over the depth cubed: what of the light lies in a pixel but for a factor.
template <bool s>
Jet<s> fluxPerDepth(const EyeView& eye, const Beam<s>& beam, const Jet<s>& distance,
                    const Jet<s>& flux) {
    const glm::dvec3 eyeAt = eye.position();
    const Vector<Jet<s>> hit = beam.at + scaled(distance, beam.along);
    const Vector<Jet<s>> offset{hit.x - Interval(eyeAt.x), hit.y - Interval(eyeAt.y),
                                hit.z - Interval(eyeAt.z)};
    const Jet<s> depth = -dot(offset, exact(eye.backward()));
    // Of what has no bounds nothing is left (modelOf).
    if (!staysAwayFromZero(depth.value)) return Jet<s>(inverse(Interval(-1.0, 1.0)));
    const Jet<s> perDepth = inverse(depth);
    return flux * (perDepth * square(perDepth));
}

// What is to be integrated over the cell: the irradiance that a pixel has of the cell's light per
// unit of the cell's area, or, where that has no good bounds, the flux. The share of a pixel that a
// square metre covers is then enclosed pixel by pixel.
struct Density {
    std::array<TaylorModel, 3> channels;
    bool isFlux = false;
    double largest = 0.0;
    double relativeWidth = 0.0;
};

void judge(const Ray& arriving, int channels, Density& density) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
        const double largest = std::max(density.channels[k].range().hi, 0.0);
        density.largest = std::max(density.largest, largest * arriving.weight[k].hi);
        density.relativeWidth = std::max(
            density.relativeWidth, density.channels[k].rest.width() / std::max(largest, 1e-300));
    }
}

// N̂·(eye - p), m, on the side that is seen.
Interval heightOfEye(const Facet& goal, const Interval& eyeHeight) {
    Interval height = eyeHeight / sqrt(dot(goal.area, goal.area));
    if (height.hi <= 0.0) height = -height;
    return intersection(height, Interval(0.0, 1e30));
}

// By |N̂·(p - eye)| / depth³ times pixels; nothing where there are no bounds.
std::optional<Density> densityOn(const EyeView& eye, const Interval& height, const Ray& arriving,
                                 const Both& distance, int channels) {
    const Interval fixed = height * square(Interval(eye.pixelsPerTangent()));
    Density density;
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
        density.channels[k] = modelOf(
            fixed * fluxPerDepth(eye, arriving.middle, distance.middle, arriving.middle.flux[k]),
            fixed * fluxPerDepth(eye, arriving.wide, distance.wide, arriving.wide.flux[k]));
        if (!density.channels[k].isFinite()) return std::nullopt;
    }
    judge(arriving, channels, density);
    return density;
}

// Nothing where the flux has no bounds.
std::optional<Density> fluxOf(const Ray& arriving, int channels) {
    Density density;
    density.isFlux = true;
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
        density.channels[k] = modelOf(arriving.middle.flux[k], arriving.wide.flux[k]);
        if (!density.channels[k].isFinite()) return std::nullopt;
    }
    judge(arriving, channels, density);
    return density;
}

// The light of a beam on a facet, on its way into pixels.
class Depositor {
  public:
    Depositor(const EyeView& eye, std::uint32_t facet, const Facet& goal, const Interval& height,
              const Screen& screen, const Density& density, const Ray& arriving, int channels)
        : eye_(eye),
          facet_(facet),
          goal_(goal),
          height_(height),
          screen_(screen),
          density_(density),
          arriving_(arriving),
          channels_(static_cast<std::size_t>(channels)) {}

    // Adds to the deposits; returns the sum of pixels' widths, W/m².
    double depositIn(const EyeView::Extent& pixels, const Visible& visible,
                     std::vector<CellResult::Deposit>& deposits) {
        double width = 0.0;
        for (int v = pixels.top; v <= pixels.bottom; ++v) {
            // First the row.
            const std::array<HalfPlane, 2> sides{screen_.edge(0.0, 1.0, -v, 0.0, 0.0),
                                                 screen_.edge(0.0, -1.0, v + 1.0, 0.0, 0.0)};
            const Polygons may = cutBy(visible.may, sides, Side::outer);
            if (may.empty()) continue;
            const Polygons sure = cutBy(visible.sure, sides, Side::inner);
            const EyeView::Extent inRow = screen_.pixelsIn(may, {pixels.left, pixels.right, v, v});
            for (int u = inRow.left; u <= inRow.right; ++u) {
                const std::array<HalfPlane, 2> ends{screen_.edge(1.0, 0.0, -u, 0.0, 0.0),
                                                    screen_.edge(-1.0, 0.0, u + 1.0, 0.0, 0.0)};
                width += depositAt(u, v, cutBy(sure, ends, Side::inner),
                                   cutBy(may, ends, Side::outer), deposits);
            }
        }
        return width;
    }

  private:
    template <class Lines>
    static Polygons cutBy(const Polygons& polygons, const Lines& lines, Side side) {
        Polygons result;
        for (Polygon polygon : polygons) {
            for (const HalfPlane& line : lines)
                polygon.cut(line, side);
            if (!polygon.isEmpty()) result.push_back(polygon);
        }
        return result;
    }

    // `sure` and `may`: what of the light is within the pixel.
    double depositAt(int u, int v, const Polygons& sure, const Polygons& may,
                     std::vector<CellResult::Deposit>& deposits) {
        if (may.empty()) return 0.0;
        const std::size_t pixel =
            static_cast<std::size_t>(v) * static_cast<std::size_t>(eye_.width()) +
            static_cast<std::size_t>(u);
        std::array<Interval, 3> sum;
        bool any = false;
        for (const SeenPart& part : eye_.parts(pixel)) {
            if (part.facet != facet_) continue;
            const Polygons& all = part.isSure ? sure : may;
            if (part.isWhole) {
                if (addIntegral(all, part.isSure, sum)) any = true;
                continue;
            }
            lines_.clear();
            for (const HalfPlane& edge : part.edges)
                lines_.push_back(
                    screen_.edge(edge.slopeX, edge.slopeY, edge.value, edge.low, edge.high));
            const Polygons seen = cutBy(all, lines_, part.isSure ? Side::inner : Side::outer);
            if (addIntegral(seen, part.isSure, sum)) any = true;
        }
        if (!any) return 0.0;
        Interval factor(1.0);
        if (density_.isFlux) factor = coverageIn(eye_, goal_, height_, u, v);
        const Colors irradiance = weighted(sum, factor);
        deposits.push_back({pixel, irradiance});
        double width = 0.0;
        for (const Interval& channel : irradiance)
            width = std::max(width, channel.width());
        return width;
    }

    // Adds the integral of the density over the polygons; whether there are any.
    bool addIntegral(const Polygons& polygons, bool isSure, std::array<Interval, 3>& sum) const {
        for (const Polygon& polygon : polygons) {
            for (std::size_t k = 0; k < channels_; ++k) {
                const double value =
                    std::max(integralBound(density_.channels[k], polygon, !isSure), 0.0);
                double& bound = isSure ? sum[k].lo : sum[k].hi;
                bound = isSure ? rounding::down(bound + value) : rounding::up(bound + value);
            }
        }
        return !polygons.empty();
    }

    [[nodiscard]] Colors weighted(const std::array<Interval, 3>& sum,
                                  const Interval& factor) const {
        Colors irradiance;
        for (std::size_t k = 0; k < 3; ++k) {
            const Interval& value = sum[channels_ == 1 ? 0 : k];
            const Interval all =
                factor *
                (Interval(std::max(value.lo, 0.0), std::max(value.hi, 0.0)) * arriving_.weight[k]);
            irradiance[k] = {std::max(all.lo, 0.0), std::max(all.hi, 0.0)};
        }
        return irradiance;
    }

    const EyeView& eye_;
    std::uint32_t facet_;
    const Facet& goal_;
    Interval height_;
    const Screen& screen_;
    const Density& density_;
    const Ray& arriving_;
    std::size_t channels_;
    std::vector<HalfPlane> lines_;
};

long countOf(const EyeView::Extent& pixels) {
    if (pixels.right < pixels.left || pixels.bottom < pixels.top) return 0;
    return (pixels.right - pixels.left + 1L) * (pixels.bottom - pixels.top + 1L);
}

EyeView::Extent common(const EyeView::Extent& a, const EyeView::Extent& b) {
    return {std::max(a.left, b.left), std::min(a.right, b.right), std::max(a.top, b.top),
            std::min(a.bottom, b.bottom)};
}

}  // namespace

bool CellTracer::deposit(const Ray& ray, const Candidate& target, const Visible& visible) {
    const Facet& goal = facet(target.facet);
    const auto giveUpHere = [&] { return giveUp(ray, visible.may, {alongOf(ray, visible.may)}); };
    Ray arriving = ray;
    std::optional<Both> distance;
    if (crossesPlane(ray, goal, target.along)) {
        distance = Both{distanceToPlane(ray.wide, goal), distanceToPlane(ray.middle, goal)};
        if (!distance->model().isFinite() || !(distance->wide.value.magnitude() < kHuge))
            distance.reset();
    }
    if (ray.medium != 0 && geometry_.absorbs()) {
        if (!distance || !(distance->wide.value.lo > -1.0)) return giveUpHere();
        absorb(geometry_, *distance, channels_, arriving);
    }
    const Interval watts = wattsOf(arriving, visible.sure, visible.may, channels_);
    if (!watts.isFinite()) return giveUpHere();
    const double share = ray.interactions > 1 ? kSmallWattsBentTwice : kSmallWatts;
    if (!isFinal_ &&
        watts.width() > std::max(share * found_.emitted.hi, 1e-10 * tracer_.wattScale()))
        return false;
    // An enclosure by which light gains watts is none to go on with.
    if (watts.hi > kMaxGain * found_.emitted.hi) return giveUpHere();
    const auto leaveUnseen = [&] {
        found_.deposited = found_.deposited + watts;
        return true;
    };
    const EyeView::Extent& extent = eye_.extent(target.facet);
    // The eye sees the side that the light arrives on.
    const Interval eyeHeight = dot(exact(eye_.position()) - exact(goal.position[0]), goal.area);
    const bool isSeen = target.along < 0.0 ? eyeHeight.hi > 0.0 : eyeHeight.lo < 0.0;
    if (countOf(extent) == 0 || !isSeen) return leaveUnseen();

    const Screen screen(eye_, ray, goal, target.along, visible.may);
    if (!screen.isFinite()) return giveUpHere();
    Visible shown = visible;
    if (screen.mayBeBehind()) {
        const auto cut = [&](Polygons& polygons, Side side) {
            for (Polygon& polygon : polygons)
                polygon.cut(screen.beforeEye(), side);
            std::erase_if(polygons, [](const Polygon& polygon) { return polygon.isEmpty(); });
        };
        cut(shown.sure, Side::inner);
        cut(shown.may, Side::outer);
    }
    EyeView::Extent pixels = screen.pixelsIn(shown.may, extent);
    if (shown.may.empty() || countOf(pixels) == 0) return leaveUnseen();
    if (countOf(pixels) > kSomePixels) {
        pixels = common(pixels, pixelsReached(geometry_, eye_, startOf(ray, shown.may),
                                              alongOf(ray, shown.may), target.facet));
        if (countOf(pixels) == 0) return leaveUnseen();
    }
    if (!isFinal_ && countOf(pixels) > kManyPixels) return false;

    const Interval height = heightOfEye(goal, eyeHeight);
    const double bandPixels = tracer_.settings().bandPixels;
    std::optional<Density> density;
    if (distance) density = densityOn(eye_, height, arriving, *distance, channels_);
    const bool isSlanted = screen.isSlanted() || !density || density->relativeWidth > 0.1;
    if (isSlanted) density = fluxOf(arriving, channels_);
    if (!density) return giveUpHere();
    if (!isFinal_ && !isSlanted &&
        density->largest * areaOf(shown.may) * static_cast<double>(countOf(pixels)) >
            kSmallIrradiance * tracer_.irradianceScale() &&
        (screen.band(pixels) > bandPixels || density->relativeWidth > 4.0 * bandPixels))
        return false;
    const std::size_t before = found_.deposits.size();
    const double width =
        Depositor(eye_, target.facet, goal, height, screen, *density, arriving, channels_)
            .depositIn(pixels, shown, found_.deposits);
    if (!isFinal_ && isSlanted && width > kSmallWidth * tracer_.irradianceScale()) {
        found_.deposits.resize(before);
        return false;
    }
    found_.deposited = found_.deposited + watts;
    return true;
}

}  // namespace kaustik::certify
