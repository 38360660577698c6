// SPDX-License-Identifier: MIT
#include "framework/certify/beams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::certify {
namespace {

// A cell of so much of the light, of all of it, is not split for what it leaves open.
constexpr double kSmallShare = 1e-9;
// The same, of irradiance in a pixel.
constexpr double kSmallIrradiance = 1e-5;
constexpr double kSmallOpen = 1e-5;
// Slopes, distances and areas that are larger than that are no enclosure to go on with.
constexpr double kHuge = 1e12;
// A cell that may reach more pixels than that is split.
constexpr long kManyPixels = 20000;

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
struct Branch {
    Vector<Jet<s>> reflected;
    Vector<Jet<s>> refracted;
    Jet<s> reflectance;
};

template <bool s>
[[nodiscard]] Vector<Jet<s>> normalized(const Vector<Jet<s>>& v) {
    return scaled(inverse(sqrt(squaredLength(v))), v);
}

// The laws of reference/optics.h. `incidence`: the cosine; `root`: of the refracted angle, squared.
template <bool s>
[[nodiscard]] Branch<s> refract(const Vector<Jet<s>>& along, const Vector<Jet<s>>& normal,
                                const Jet<s>& incidence, const Jet<s>& root, const Interval& eta) {
    Branch<s> result;
    const Jet<s> exit = sqrt(root);
    const Jet<s> slowed = eta * incidence;
    result.refracted = scaled(eta, along) + scaled(slowed - exit, normal);
    const Jet<s> a = (slowed - exit) * inverse(slowed + exit);
    const Jet<s> b = (incidence - eta * exit) * inverse(incidence + eta * exit);
    result.reflectance = Interval(0.5) * (square(a) + square(b));
    return result;
}

template <bool s>
[[nodiscard]] Vector<Jet<s>> reflect(const Vector<Jet<s>>& along, const Vector<Jet<s>>& normal,
                                     const Jet<s>& incidence) {
    return along + scaled(Interval(2.0) * incidence, normal);
}

template <bool s>
[[nodiscard]] Vector<Jet<s>> constant(const Vec& v) {
    return {Jet<s>(v.x), Jet<s>(v.y), Jet<s>(v.z)};
}

Vec negated(const Vec& v) {
    return {-v.x, -v.y, -v.z};
}

bool isFinite(const Vec& v) {
    return v.x.isFinite() && v.y.isFinite() && v.z.isFinite();
}

// The box around polygons of the cell, by a hair wider.
struct Extent {
    Point low{1e300, 1e300};
    Point high{-1e300, -1e300};
};
Extent extentOf(const Polygons& polygons) {
    constexpr double kHair = 1e-9;
    Extent extent;
    for (const Polygon& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            extent.low.x = std::min(extent.low.x, polygon[i].x - kHair);
            extent.low.y = std::min(extent.low.y, polygon[i].y - kHair);
            extent.high.x = std::max(extent.high.x, polygon[i].x + kHair);
            extent.high.y = std::max(extent.high.y, polygon[i].y + kHair);
        }
    }
    return extent;
}
bool overlap(const Extent& a, const Extent& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

HalfPlane lineOf(const TaylorModel& model, double sign) {
    const Interval rest = sign > 0.0 ? model.rest : -model.rest;
    return {sign * model.value, sign * model.slope[0], sign * model.slope[1], rest.lo, rest.hi};
}

// The values of what is linear but for its rest, over polygons.
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

}  // namespace

struct BeamTracer::Work {
    struct Deposit {
        std::size_t pixel = 0;
        Colors irradiance;
    };
    struct Lost {
        std::size_t facet = 0;
        std::array<double, 3> watts{};
    };
    // In pixels [left, right] and [top, bottom] that see the facet.
    struct Open {
        std::uint32_t facet = 0;
        EyeView::Extent extent;
        std::array<double, 3> watts{};
        // The largest in its corners: about what it is in the pixels.
        [[nodiscard]] double coverage(const EyeView& eye) const {
            double most = 0.0;
            for (const int y : {extent.top, extent.bottom}) {
                for (const int x : {extent.left, extent.right}) {
                    most =
                        std::max(most, eye.maxCoverage(static_cast<std::size_t>(y) *
                                                           static_cast<std::size_t>(eye.width()) +
                                                       static_cast<std::size_t>(x)));
                }
            }
            return most;
        }
    };
    // Sent to the sums when all of a cell is done; forgotten when it is split.
    struct Found {
        std::vector<Deposit> deposits;
        std::vector<Lost> undecided;
        std::vector<Open> open;
        double lost = 0.0;
        Interval emitted;
        Interval deposited;
        Interval limited;
        void clear() {
            deposits.clear();
            undecided.clear();
            open.clear();
            lost = 0.0;
            emitted = deposited = limited = Interval(0.0);
        }
    };
    // A facet that a ray may hit.
    struct Candidate {
        std::uint32_t facet = 0;
        double along = 1.0;  // the sign of direction · normal
        Region region;
        Polygons may;
        Extent extent;  // of `may`
    };
    struct Cell {
        std::array<double, 2> corner{};
        std::array<std::array<double, 2>, 2> sides{};
        int depth = 0;
    };

    const BeamTracer& tracer;
    const Geometry& geometry;
    const EyeView& eye;
    const Source& source;
    std::uint32_t first;
    BoundSums& sums;
    int channels;
    std::array<Interval, 3> power;
    bool isFinal = false;  // what cannot be decided is not split but given up
    double share = 0.0;    // of the cell, W
    Found found;
    std::vector<std::pair<Region, Region>> shadows;  // outer and inner, in barycentrics

    [[nodiscard]] const Facet& facet(std::uint32_t i) const { return geometry.facets()[i]; }

    // What is given up: light from the range of the ray's places, in any direction of the boxes;
    // none of these: nobody knows where. False: split instead. True: wherever it may go, it is in
    // the upper bounds.
    bool giveUp(const Ray& ray, const Polygons& may, const std::vector<Vec>& directions);
    [[nodiscard]] static double meanOf(const std::array<double, 3>& watts) {
        return rounding::up(rounding::up(rounding::up(watts[0] + watts[1]) + watts[2]) / 3.0);
    }

    // W, the mean of channels, between all that is sure and all that may be.
    [[nodiscard]] Interval wattsOf(const Ray& ray, const Polygons& sure,
                                   const Polygons& may) const {
        Interval sum(0.0);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t k = channels == 1 ? 0 : c;
            const TaylorModel model = modelOf(ray.middle.flux[k], ray.wide.flux[k]);
            sum = sum + ray.weight[c] * integral(model, sure, may);
        }
        return sum / Interval(3.0);
    }

    [[nodiscard]] static double part(const TaylorModel& model, const Polygon& polygon, bool high) {
        const Polygon::Moments m = polygon.moments();
        const double linear = model.value * m.area + model.slope[0] * m.x + model.slope[1] * m.y;
        const bool isCell = m.area >= 0.5;
        const Interval& rest = isCell ? model.restMean : model.rest;
        const double size = std::fabs(model.value) + std::fabs(model.slope[0]) +
                            std::fabs(model.slope[1]) + rest.magnitude();
        return high ? linear + std::fabs(m.area) * rest.hi + size * kAreaSlack
                    : linear + std::fabs(m.area) * rest.lo - size * kAreaSlack;
    }
    [[nodiscard]] static Interval integral(const TaylorModel& model, const Polygons& sure,
                                           const Polygons& may) {
        double low = 0.0;
        for (const Polygon& polygon : sure)
            low += std::max(part(model, polygon, false), 0.0);
        double high = 0.0;
        for (const Polygon& polygon : may)
            high += std::max(part(model, polygon, true), 0.0);
        return {rounding::down(low * (1.0 - 1e-15)), rounding::up(high * (1.0 + 1e-15))};
    }

    // All of a cell; false where it is to be split.
    bool traceCell(const Cell& cell);
    bool interact(const Ray& ray, std::uint32_t at, bool enters, const Both& b, const Both& c);
    bool advance(const Ray& ray);
    [[nodiscard]] static Vec alongOf(const Ray& ray, const Polygons& may);
    [[nodiscard]] EyeView::Extent reach(const Vec& start, const Vec& along,
                                        std::uint32_t facet) const;
    void addOpen(const Open& open);
    bool deposit(const Ray& ray, const Candidate& target, const Polygons& sure,
                 const Polygons& may);
    void split(const Cell& cell);
    void findShadows();
    [[nodiscard]] Region hitRegion(const Ray& ray, const std::vector<glm::dvec3>& corners,
                                   const Facet& plane, double along, double slack) const;
};

// Directions of the ray over polygons.
Vec BeamTracer::Work::alongOf(const Ray& ray, const Polygons& may) {
    return {rangeOver(modelOf(ray.middle.along.x, ray.wide.along.x), may),
            rangeOver(modelOf(ray.middle.along.y, ray.wide.along.y), may),
            rangeOver(modelOf(ray.middle.along.z, ray.wide.along.z), may)};
}

bool BeamTracer::Work::giveUp(const Ray& ray, const Polygons& may,
                              const std::vector<Vec>& directions) {
    const double area = rounding::up(areaOf(may)) + kAreaSlack;
    std::array<double, 3> watts;
    double most = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const Jet<true>& flux = ray.wide.flux[channels == 1 ? 0 : c];
        const double bound = flux.value.hi;
        if (!std::isfinite(bound)) return false;
        watts[c] = rounding::up(rounding::up(std::max(bound, 0.0) * area) * ray.weight[c].hi);
        most = std::max(most, watts[c]);
    }
    const Vec start{rangeOver(modelOf(ray.middle.at.x, ray.wide.at.x), may),
                    rangeOver(modelOf(ray.middle.at.y, ray.wide.at.y), may),
                    rangeOver(modelOf(ray.middle.at.z, ray.wide.at.z), may)};
    bool isAnywhere = directions.empty() || !isFinite(start);
    std::vector<Open> reached;
    for (const Vec& along : directions) {
        if (!isFinite(along)) isAnywhere = true;
        if (isAnywhere) break;
        geometry.sweep(start, along, 1e30, [&](std::uint32_t g) {
            if (g == ray.start || isAnywhere) return;
            const Facet& other = facet(g);
            if (!other.isReceiver()) {
                // Light that may meet another interaction may go anywhere from there.
                if (ray.interactions < tracer.settings_.interactions) isAnywhere = true;
                return;
            }
            const EyeView::Extent extent = reach(start, along, g);
            if (extent.right >= extent.left && extent.bottom >= extent.top)
                reached.push_back({g, extent, watts});
        });
    }
    if (!isFinal) {
        // Light that is too little to see wherever it goes is not worth more cells.
        const double limit = kSmallOpen * tracer.irradianceScale_;
        if (isAnywhere) return false;
        for (const Open& open : reached) {
            if (most * open.coverage(eye) > limit) return false;
        }
    }
    const double mean = meanOf(watts);
    found.deposited = found.deposited + Interval(0.0, mean);
    found.lost = rounding::up(found.lost + mean);
    if (isAnywhere) {
        found.undecided.push_back({geometry.facets().size(), watts});
    } else {
        found.open.insert(found.open.end(), reached.begin(), reached.end());
    }
    return true;
}

// The pixels in which a facet is seen where rays from a box may meet it.
EyeView::Extent BeamTracer::Work::reach(const Vec& start, const Vec& along, std::uint32_t g) const {
    const Facet& other = facet(g);
    EyeView::Extent extent = eye.extent(g);
    const Interval closing = dot(along, other.area);
    if (!staysAwayFromZero(closing)) return extent;
    const Interval ahead = dot(exact(other.position[0]) - start, other.area);
    Interval distance = ahead / closing;
    if (!distance.isFinite()) return extent;
    if (distance.hi < 0.0) return {};
    distance.lo = std::max(distance.lo, 0.0);
    const Vec offset = start + scaled(distance, along) - exact(eye.position());
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

void BeamTracer::Work::addOpen(const Open& open) {
    for (int y = open.extent.top; y <= open.extent.bottom; ++y) {
        for (int x = open.extent.left; x <= open.extent.right; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.width()) +
                static_cast<std::size_t>(x);
            for (const SeenPart& seen : eye.parts(pixel)) {
                if (seen.facet != open.facet) continue;
                std::array<double, 3> irradiance;
                for (std::size_t c = 0; c < 3; ++c)
                    irradiance[c] = rounding::up(open.watts[c] * eye.maxCoverage(pixel));
                sums.addOpen(pixel, irradiance);
                break;
            }
        }
    }
}

// What of the triangle lies behind something else, seen from the light: straight lines in the
// triangle's own coordinates.
void BeamTracer::Work::findShadows() {
    const Facet& own = facet(first);
    Vec start;
    Vec velocity;
    Box box;
    for (std::size_t i = 0; i < own.corners; ++i)
        box.include(own.position[i]);
    start = {Interval(box.low.x, box.high.x), Interval(box.low.y, box.high.y),
             Interval(box.low.z, box.high.z)};
    double end = 1e30;
    glm::dvec3 from;
    if (source.isDistant) {
        velocity = negated(source.direction);
        const glm::dvec3 towards(velocity.x.middle(), velocity.y.middle(), velocity.z.middle());
        from = own.position[0] + towards * (2.0 * geometry.size());
    } else {
        velocity = exact(source.position) - start;
        end = 1.0;
        from = source.position;
    }
    const glm::dvec3 a = own.position[0];
    const glm::dvec3 ab = own.position[1] - a;
    const glm::dvec3 ac = own.position[2] - a;
    const glm::dvec3 area = glm::cross(ab, ac);
    const double area2 = glm::dot(area, area);
    const double sideLength = std::sqrt(std::sqrt(area2));
    // What is in front by a hair and no more is not looked at twice.
    geometry.sweep(start, velocity, end, [&](std::uint32_t g) {
        if (g == first || g == tracer.planted_.droppedFacet) return;
        const Facet& other = facet(g);
        std::pair<Region, Region> both;
        for (const Side side : {Side::outer, Side::inner}) {
            std::vector<glm::dvec3> corners = partBefore(other, own, from, geometry.size(), side);
            if (corners.empty()) continue;
            std::vector<Point> outline;
            double reach = 1.0;
            bool isBehindLight = false;
            for (const glm::dvec3& p : corners) {
                glm::dvec3 onPlane;
                if (source.isDistant) {
                    const glm::dvec3 along(source.direction.x.middle(), source.direction.y.middle(),
                                           source.direction.z.middle());
                    onPlane = p + glm::dot(a - p, area) / glm::dot(along, area) * along;
                } else {
                    const glm::dvec3 along = p - source.position;
                    const double closing = glm::dot(along, area);
                    const double height = glm::dot(a - source.position, area);
                    // Beyond the light it throws no shadow; near its height all of the plane.
                    if (closing * height <= 1e-6 * height * height) isBehindLight = true;
                    onPlane = source.position + height / closing * along;
                }
                const glm::dvec3 step = onPlane - a;
                outline.push_back({glm::dot(glm::cross(step, ac), area) / area2,
                                   glm::dot(glm::cross(ab, step), area) / area2});
                reach = std::max({reach, std::fabs(outline.back().x), std::fabs(outline.back().y)});
            }
            const double hair = (kNear * geometry.size() / sideLength + 1e-12) * reach;
            if (isBehindLight) {
                // All may be in shadow, and nothing is for sure.
                if (side == Side::outer) both.first.push_back({1.0, 0.0, 0.0, 0.0, 0.0});
                continue;
            }
            (side == Side::outer ? both.first : both.second) = regionOf(outline, hair);
        }
        if (both.first.empty()) return;
        Polygon all = Polygon::cell();
        for (const HalfPlane& line : both.first)
            all.cut(line, Side::outer);
        if (!all.isEmpty()) shadows.push_back(std::move(both));
    });
}

bool BeamTracer::Work::traceCell(const Cell& cell) {
    found.clear();
    const Facet& own = facet(first);
    Ray ray;
    ray.start = first;
    ray.sure = ray.may = {Polygon::cell()};
    for (const auto& [outer, inner] : shadows) {
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
        subtract(ray.sure, inCell(outer), Side::outer);
        subtract(ray.may, inCell(inner), Side::inner);
    }
    if (ray.may.empty()) return true;

    const auto seed = [&](std::size_t axis) {
        Both place;
        const Interval corner(cell.corner[axis]);
        const Interval x(cell.sides[0][axis]);
        const Interval y(cell.sides[1][axis]);
        place.wide.value = corner + x * Interval(0.0, 1.0) + y * Interval(0.0, 1.0);
        place.wide.gradient = {x, y};
        place.middle.value = corner + (x + y) / Interval(3.0);
        place.middle.gradient = {x, y};
        return place;
    };
    const Both b = seed(0);
    const Both c = seed(1);
    const Vec a = exact(own.position[0]);
    const Vec ab = exact(own.position[1]) - a;
    const Vec ac = exact(own.position[2]) - a;
    const Interval scale(std::ldexp(1.0, -2 * cell.depth));
    bool enters = true;
    const auto start = [&](auto& beam, const auto& u, const auto& v) {
        using J = std::decay_t<decltype(u)>;
        beam.at = {a.x + (ab.x * u + ac.x * v), a.y + (ab.y * u + ac.y * v),
                   a.z + (ab.z * u + ac.z * v)};
        J density;
        if (source.isDistant) {
            beam.along = {J(source.direction.x), J(source.direction.y), J(source.direction.z)};
            const Interval closing = dot(source.direction, own.area);
            enters = closing.hi < 0.0;
            density = J(scale * (enters ? -closing : closing));
        } else {
            const Vector<J> away{beam.at.x - Interval(source.position.x),
                                 beam.at.y - Interval(source.position.y),
                                 beam.at.z - Interval(source.position.z)};
            const J perLength = inverse(sqrt(squaredLength(away)));
            beam.along = scaled(perLength, away);
            const Interval closing = dot(a - exact(source.position), own.area);
            enters = closing.hi < 0.0;
            density = (scale * (enters ? -closing : closing)) * (perLength * square(perLength));
        }
        beam.flux = {density, density, density};
    };
    start(ray.wide, b.wide, c.wide);
    start(ray.middle, b.middle, c.middle);
    ray.weight = power;
    if (!std::isfinite(ray.wide.flux[0].value.lo + ray.wide.flux[0].value.hi) ||
        !(ray.wide.flux[0].value.hi < kHuge * tracer.wattScale_)) {
        return false;
    }
    found.emitted = wattsOf(ray, ray.sure, ray.may);
    share = found.emitted.hi;
    isFinal = cell.depth >= tracer.settings_.maxDepth || share <= kSmallShare * tracer.wattScale_;
    // On the border of a shadow.
    if (!isFinal && found.emitted.width() > 1e-7 * tracer.wattScale_) return false;
    // Light whose first surface is a dielectric's back comes from within it.
    const bool isWithin = !enters && own.kind == scene::MaterialKind::dielectric;
    if (isWithin) ray.medium = own.material + 1;
    const bool isDimmed = isWithin && !source.isDistant && geometry.absorbs();
    const bool done = isDimmed ? giveUp(ray, ray.may, {}) : interact(ray, first, enters, b, c);
    if (done || !isFinal) return done;
    // Not even bounds of what goes which way: it is all given up.
    found.deposits.clear();
    found.undecided.clear();
    found.open.clear();
    found.lost = 0.0;
    found.deposited = found.limited = Interval(0.0);
    return giveUp(ray, ray.may, {});
}

// Follows the light on from a specular facet at the barycentrics b and c.
bool BeamTracer::Work::interact(const Ray& ray, std::uint32_t at, bool enters, const Both& b,
                                const Both& c) {
    const Facet& own = facet(at);
    const scene::Material& material = geometry.scene().materials[own.material];
    const bool isMirror = own.kind == scene::MaterialKind::mirror;
    const double side = enters ? 1.0 : -1.0;
    const Vec geometric = enters ? own.area : negated(own.area);

    const auto interpolated = [&](const auto& u, const auto& v) {
        const Vec n = exact(side * own.normal[0]);
        const Vec nb = exact(side * own.normal[1]) - n;
        const Vec nc = exact(side * own.normal[2]) - n;
        using J = std::decay_t<decltype(u)>;
        return Vector<J>{n.x + (nb.x * u + nc.x * v), n.y + (nb.y * u + nc.y * v),
                         n.z + (nb.z * u + nc.z * v)};
    };
    const Vector<Jet<true>> wideNormal = interpolated(b.wide, c.wide);
    // The reference moves a normal that is short or on the other side of its triangle; such a
    // surface is given up.
    if (!(squaredLength(wideNormal).value.lo > 1e-24) ||
        !(dot(wideNormal, geometric).value.lo > 0.0)) {
        return giveUp(ray, ray.may, {});
    }
    const Interval geometricLength =
        sqrt(square(geometric.x) + square(geometric.y) + square(geometric.z));
    const Vec geometricUnit = scaled(inverse(geometricLength), geometric);

    Ray next = ray;
    next.start = at;
    next.interactions = ray.interactions + 1;
    // Where light may go that is given up here: by either normal.
    const auto giveUpHere = [&] {
        const Vec along = alongOf(ray, ray.may);
        const Interval perLength = inverse(sqrt(squaredLength(wideNormal).value));
        const Vec shading{perLength * wideNormal.x.value, perLength * wideNormal.y.value,
                          perLength * wideNormal.z.value};
        std::vector<Vec> directions;
        for (const Vec& normal : {shading, geometricUnit}) {
            Interval cosine = -dot(along, normal);
            if (cosine.hi < 0.0) continue;
            cosine.lo = std::max(cosine.lo, 0.0);
            directions.push_back(along + scaled(Interval(2.0) * cosine, normal));
            if (isMirror) continue;
            const Interval inside(static_cast<double>(material.ior));
            const Interval eta = enters ? Interval(1.0) / inside : inside;
            Interval root = Interval(1.0) - square(eta) * (Interval(1.0) - square(cosine));
            if (root.hi < 0.0) continue;
            root.lo = std::max(root.lo, 0.0);
            directions.push_back(scaled(eta, along) + scaled(eta * cosine - sqrt(root), normal));
        }
        return giveUp(next, ray.may, directions);
    };

    // Which normal bends the light: the interpolated one, unless it would send it to the wrong
    // side.
    for (int attempt = 0; attempt < 2; ++attempt) {
        const auto unitNormal = [&](const auto& u, const auto& v) {
            using J = std::decay_t<decltype(u)>;
            constexpr bool s = std::is_same_v<J, Jet<true>>;
            return attempt == 0 ? normalized(interpolated(u, v)) : constant<s>(geometricUnit);
        };
        const Vector<Jet<true>> normal = unitNormal(b.wide, c.wide);
        const Jet<true> incidence = -dot(ray.wide.along, normal);
        if (attempt == 0 && incidence.value.hi <= 0.0) continue;
        if (!(incidence.value.lo > 0.0)) return giveUpHere();
        const Vector<Jet<false>> middleNormal = unitNormal(b.middle, c.middle);
        const Jet<false> middleIncidence = -dot(ray.middle.along, middleNormal);

        next.wide.at = ray.wide.at;
        next.middle.at = ray.middle.at;
        const Vector<Jet<true>> reflected = reflect(ray.wide.along, normal, incidence);
        const Interval outwards = dot(reflected, geometric).value;
        const bool isReflectedRight = outwards.lo > 0.0;
        const bool isReflectedWrong = outwards.hi <= 0.0;
        const auto followReflected = [&](Ray onward) {
            onward.wide.along = reflected;
            onward.middle.along = reflect(ray.middle.along, middleNormal, middleIncidence);
            return advance(onward);
        };
        if (isMirror) {
            if (attempt == 0 && isReflectedWrong) continue;
            if (attempt == 0 && !isReflectedRight) return giveUpHere();
            for (std::size_t k = 0; k < 3; ++k) {
                next.weight[k] =
                    ray.weight[k] *
                    Interval(static_cast<double>(material.albedo[static_cast<int>(k)]));
            }
            return followReflected(next);
        }
        const std::uint32_t own1 = own.material + 1;
        // Bodies within bodies are given up.
        if (enters ? ray.medium != 0 : ray.medium != own1) return giveUp(ray, ray.may, {});
        const Interval inside(static_cast<double>(material.ior));
        const Interval eta = enters ? Interval(1.0) / inside : inside;
        const auto rootOf = [&](const auto& cosine) {
            return (square(eta) * square(cosine)) + (Interval(1.0) - square(eta));
        };
        const Jet<true> root = rootOf(incidence);
        if (root.value.hi <= 0.0) {
            if (attempt == 0 && isReflectedWrong) continue;
            if (attempt == 0 && !isReflectedRight) return giveUpHere();
            return followReflected(next);
        }
        if (!(root.value.lo > 1e-9)) return giveUpHere();
        const Branch<true> wide = refract(ray.wide.along, normal, incidence, root, eta);
        const Interval inwards = dot(wide.refracted, geometric).value;
        if (attempt == 0 && (isReflectedWrong || inwards.lo >= 0.0)) continue;
        if (attempt == 0 && !(isReflectedRight && inwards.hi < 0.0)) return giveUpHere();
        const Branch<false> middle =
            refract(ray.middle.along, middleNormal, middleIncidence, rootOf(middleIncidence), eta);
        const std::size_t used = static_cast<std::size_t>(channels);
        Ray through = next;
        through.medium = enters ? own1 : 0;
        through.wide.along = wide.refracted;
        through.middle.along = middle.refracted;
        const Interval planted(tracer.planted_.fresnelFactor);
        for (std::size_t k = 0; k < used; ++k) {
            through.wide.flux[k] =
                planted * (ray.wide.flux[k] * (Interval(1.0) - wide.reflectance));
            through.middle.flux[k] =
                planted * (ray.middle.flux[k] * (Interval(1.0) - middle.reflectance));
            // A share of what has arrived, whatever the enclosure of the share is.
            through.wide.flux[k].value.lo = std::max(through.wide.flux[k].value.lo, 0.0);
        }
        if (!advance(through)) return false;
        if (tracer.settings_.transmissionOnly) return true;
        for (std::size_t k = 0; k < used; ++k) {
            next.wide.flux[k] = ray.wide.flux[k] * wide.reflectance;
            next.middle.flux[k] = ray.middle.flux[k] * middle.reflectance;
            next.wide.flux[k].value.lo = std::max(next.wide.flux[k].value.lo, 0.0);
        }
        return followReflected(next);
    }
    return giveUpHere();
}

// Where the ray meets the plane within the corners: polynomials of origin and direction, so that
// rays along the plane are no trouble. `slack`: by which the corners may be off, m. Nothing where
// it surely does not.
Region BeamTracer::Work::hitRegion(const Ray& ray, const std::vector<glm::dvec3>& corners,
                                   const Facet& plane, double along, double slack) const {
    Region region;
    const Interval off(-slack, slack);
    const auto fromOrigin = [&](const auto& beam, const glm::dvec3& p) {
        using J = std::decay_t<decltype(beam.at.x)>;
        return Vector<J>{(Interval(p.x) + off) - beam.at.x, (Interval(p.y) + off) - beam.at.y,
                         (Interval(p.z) + off) - beam.at.z};
    };
    std::vector<Vector<Jet<true>>> wide;
    std::vector<Vector<Jet<false>>> middle;
    for (const glm::dvec3& p : corners) {
        wide.push_back(fromOrigin(ray.wide, p));
        middle.push_back(fromOrigin(ray.middle, p));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t j = (i + 1) % corners.size();
        const TaylorModel model = modelOf(dot(ray.middle.along, cross(middle[i], middle[j])),
                                          dot(ray.wide.along, cross(wide[i], wide[j])));
        region.push_back(lineOf(model, along));
    }
    // In front of the origin.
    const TaylorModel ahead = modelOf(dot(middle[0], constant<false>(plane.area)),
                                      dot(wide[0], constant<true>(plane.area)));
    region.push_back(lineOf(ahead, along));
    const Jet<true> closing = dot(ray.wide.along, constant<true>(plane.area));
    if (!(along > 0.0 ? closing.value.lo > 0.0 : closing.value.hi < 0.0)) {
        region.push_back(
            lineOf(modelOf(dot(ray.middle.along, constant<false>(plane.area)), closing), along));
    }
    return region;
}

// What a ray may hit next, and what of it.
bool BeamTracer::Work::advance(const Ray& ray) {
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
    std::vector<Candidate> candidates;
    const double slack = 1e-13 * geometry.size();
    geometry.sweep(start, velocity, 1e30, [&](std::uint32_t g) {
        if (g == ray.start || g == tracer.planted_.droppedFacet) return;
        const Facet& other = facet(g);
        const Interval closing = dot(velocity, other.area);
        const Interval ahead = dot(exact(other.position[0]) - start, other.area);
        for (const double along : {1.0, -1.0}) {
            if (along > 0.0 ? closing.hi <= 0.0 || ahead.hi < 0.0
                            : closing.lo >= 0.0 || ahead.lo > 0.0)
                continue;
            // By the side rule of the reference.
            const bool leaves = along > 0.0;
            if (other.kind == scene::MaterialKind::dielectric &&
                leaves != (ray.medium == other.material + 1))
                continue;
            if (other.kind == scene::MaterialKind::mirror && other.isClosed && leaves) continue;
            const std::vector<glm::dvec3> corners(
                other.position.begin(), other.position.begin() + static_cast<long>(other.corners));
            bool apart = false;
            for (std::size_t i = 0; i < corners.size() && !apart; ++i) {
                const Interval edge =
                    dot(velocity, cross(exact(corners[i]) - start,
                                        exact(corners[(i + 1) % corners.size()]) - start));
                apart = along > 0.0 ? edge.hi < 0.0 : edge.lo > 0.0;
            }
            if (apart) continue;
            Candidate candidate;
            candidate.facet = g;
            candidate.along = along;
            candidate.region = hitRegion(ray, corners, other, along, 0.0);
            for (Polygon polygon : ray.may) {
                for (const HalfPlane& line : candidate.region)
                    polygon.cut(line, Side::outer);
                if (!polygon.isEmpty()) candidate.may.push_back(polygon);
            }
            candidate.extent = extentOf(candidate.may);
            if (!candidate.may.empty()) candidates.push_back(std::move(candidate));
        }
    });
    for (const Candidate& target : candidates) {
        const Facet& goal = facet(target.facet);
        Polygons may = target.may;
        Polygons sure;
        for (Polygon polygon : ray.sure) {
            for (const HalfPlane& line : target.region)
                polygon.cut(line, Side::inner);
            if (!polygon.isEmpty()) sure.push_back(polygon);
        }
        for (const Candidate& other : candidates) {
            if (other.facet == target.facet || !overlap(other.extent, target.extent)) continue;
            const Facet& blocker = facet(other.facet);
            const glm::dvec3 from = goal.position[0] - target.along * goal.unit;
            for (const Side side : {Side::outer, Side::inner}) {
                Polygons& left = side == Side::outer ? sure : may;
                if (left.empty()) continue;
                const std::vector<glm::dvec3> corners =
                    partBefore(blocker, goal, from, geometry.size(), side);
                if (corners.empty()) continue;
                const bool isAll =
                    corners.size() == blocker.corners &&
                    std::equal(corners.begin(), corners.end(), blocker.position.begin());
                subtract(
                    left,
                    isAll ? other.region : hitRegion(ray, corners, blocker, other.along, slack),
                    side);
            }
        }
        if (may.empty()) continue;
        if (goal.isReceiver()) {
            if (!deposit(ray, target, sure, may)) return false;
            continue;
        }
        if (ray.interactions >= tracer.settings_.interactions) {
            found.limited = found.limited + wattsOf(ray, sure, may);
            continue;
        }
        // On to the next interaction.
        const Interval closing = dot(ray.wide.along, constant<true>(goal.area)).value;
        if (!(target.along > 0.0 ? closing.lo > kSmallestDivisor
                                 : closing.hi < -kSmallestDivisor)) {
            if (!giveUp(ray, may, {alongOf(ray, may)})) return false;
            continue;
        }
        Ray next = ray;
        next.sure = sure;
        next.may = may;
        Both b;
        Both c;
        const Vec a = exact(goal.position[0]);
        const Vec ab = exact(goal.position[1]) - a;
        const Vec ac = exact(goal.position[2]) - a;
        const Interval perArea2 =
            inverse(square(goal.area.x) + square(goal.area.y) + square(goal.area.z));
        const Vec alongB = scaled(perArea2, cross(ac, goal.area));
        const Vec alongC = scaled(perArea2, cross(goal.area, ab));
        const scene::Material* filling =
            ray.medium == 0 ? nullptr : &geometry.scene().materials[ray.medium - 1];
        const auto arrive = [&](const auto& beam, auto& onward, auto& u, auto& v) {
            using J = std::decay_t<decltype(u)>;
            constexpr bool s = std::is_same_v<J, Jet<true>>;
            const Vector<J> toPlane{a.x - beam.at.x, a.y - beam.at.y, a.z - beam.at.z};
            const J distance = dot(toPlane, constant<s>(goal.area)) *
                               inverse(dot(beam.along, constant<s>(goal.area)));
            onward.at = beam.at + scaled(distance, beam.along);
            const Vector<J> step{onward.at.x - a.x, onward.at.y - a.y, onward.at.z - a.z};
            u = dot(step, constant<s>(alongB));
            v = dot(step, constant<s>(alongC));
            if (filling == nullptr || !geometry.absorbs()) return;
            for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
                const Interval perMeter(
                    static_cast<double>(filling->absorptionPerMeter[static_cast<int>(k)]));
                onward.flux[k] = beam.flux[k] * exp(-perMeter * distance);
            }
        };
        arrive(ray.wide, next.wide, b.wide, c.wide);
        arrive(ray.middle, next.middle, b.middle, c.middle);
        if (!interact(next, target.facet, target.along < 0.0, b, c)) return false;
    }
    return true;
}

bool BeamTracer::Work::deposit(const Ray& ray, const Candidate& target, const Polygons& sure,
                               const Polygons& may) {
    const Facet& goal = facet(target.facet);
    const Interval closing = dot(ray.wide.along, constant<true>(goal.area)).value;
    if (!(target.along > 0.0 ? closing.lo > kSmallestDivisor : closing.hi < -kSmallestDivisor))
        return giveUp(ray, may, {alongOf(ray, may)});
    const scene::Material* filling =
        ray.medium == 0 ? nullptr : &geometry.scene().materials[ray.medium - 1];
    const Vec a = exact(goal.position[0]);
    const auto distanceOf = [&](const auto& beam) {
        using J = std::decay_t<decltype(beam.at.x)>;
        constexpr bool s = std::is_same_v<J, Jet<true>>;
        const Vector<J> toPlane{a.x - beam.at.x, a.y - beam.at.y, a.z - beam.at.z};
        return dot(toPlane, constant<s>(goal.area)) *
               inverse(dot(beam.along, constant<s>(goal.area)));
    };
    const Both distance{distanceOf(ray.wide), distanceOf(ray.middle)};
    if (!distance.model().isFinite() || !(distance.wide.value.magnitude() < kHuge))
        return giveUp(ray, may, {alongOf(ray, may)});
    Ray arriving = ray;
    if (filling != nullptr && geometry.absorbs()) {
        if (!(distance.wide.value.lo > -1.0)) return giveUp(ray, may, {alongOf(ray, may)});
        for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
            const Interval perMeter(
                static_cast<double>(filling->absorptionPerMeter[static_cast<int>(k)]));
            arriving.wide.flux[k] = ray.wide.flux[k] * exp(-perMeter * distance.wide);
            arriving.middle.flux[k] = ray.middle.flux[k] * exp(-perMeter * distance.middle);
        }
    }
    const Interval watts = wattsOf(arriving, sure, may);
    if (!watts.isFinite()) return giveUp(ray, may, {alongOf(ray, may)});
    if (!isFinal && watts.width() > 1e-6 * tracer.wattScale_) return false;
    const EyeView::Extent& extent = eye.extent(target.facet);
    // The eye sees the side that the light arrives on.
    const glm::dvec3 eyeAt = eye.position();
    const Interval eyeHeight = dot(exact(eyeAt) - a, goal.area);
    const bool isSeen = target.along < 0.0 ? eyeHeight.hi > 0.0 : eyeHeight.lo < 0.0;
    if (extent.right < extent.left || extent.bottom < extent.top || !isSeen) {
        found.deposited = found.deposited + watts;
        return true;
    }
    const Vec right = exact(eye.right());
    const Vec up = exact(eye.up());
    const Vec backward = exact(eye.backward());
    Both column;
    Both row;
    Both depth;
    const auto look = [&](const auto& beam, const auto& far, auto& x, auto& y, auto& z) {
        using J = std::decay_t<decltype(x)>;
        constexpr bool s = std::is_same_v<J, Jet<true>>;
        const Vector<J> hit = beam.at + scaled(far, beam.along);
        const Vector<J> offset{hit.x - Interval(eyeAt.x), hit.y - Interval(eyeAt.y),
                               hit.z - Interval(eyeAt.z)};
        z = -dot(offset, constant<s>(backward));
        if (!staysAwayFromZero(z.value)) return;
        const J perDepth = inverse(z);
        const Interval ppt(eye.pixelsPerTangent());
        x = ppt * (dot(offset, constant<s>(right)) * perDepth + Interval(eye.tangents().x));
        y = ppt * (Interval(eye.tangents().y) - dot(offset, constant<s>(up)) * perDepth);
    };
    look(ray.wide, distance.wide, column.wide, row.wide, depth.wide);
    look(ray.middle, distance.middle, column.middle, row.middle, depth.middle);
    const TaylorModel depthModel = depth.model();
    if (depthModel.isFinite() && rangeOver(depthModel, may).hi < eye.nearMeters()) {
        found.deposited = found.deposited + watts;
        return true;
    }
    if (!(depth.wide.value.lo > 0.5 * eye.nearMeters()))
        return giveUp(ray, may, {alongOf(ray, may)});
    const TaylorModel x = column.model();
    const TaylorModel y = row.model();
    if (!x.isFinite() || !y.isFinite()) return giveUp(ray, may, {alongOf(ray, may)});
    const Interval rangeX = rangeOver(x, may);
    const Interval rangeY = rangeOver(y, may);
    if (rangeX.hi < extent.left || rangeX.lo > extent.right + 1 || rangeY.hi < extent.top ||
        rangeY.lo > extent.bottom + 1) {
        found.deposited = found.deposited + watts;
        return true;
    }
    const int left = static_cast<int>(std::max<double>(std::floor(rangeX.lo), extent.left));
    const int last = static_cast<int>(std::min<double>(std::floor(rangeX.hi), extent.right));
    const int top = static_cast<int>(std::max<double>(std::floor(rangeY.lo), extent.top));
    const int bottom = static_cast<int>(std::min<double>(std::floor(rangeY.hi), extent.bottom));
    if (!isFinal && (last - left + 1L) * (bottom - top + 1L) > kManyPixels) return false;

    // The share of a pixel that a square metre covers: |N̂·(p - eye)| / depth³, times pixels.
    const Interval areaLength =
        sqrt(square(goal.area.x) + square(goal.area.y) + square(goal.area.z));
    Interval height = eyeHeight / areaLength;
    if (height.hi <= 0.0) height = -height;
    height = intersection(height, Interval(0.0, 1e30));
    const Interval fixed = height * square(Interval(eye.pixelsPerTangent()));
    std::array<TaylorModel, 3> density;
    double worst = 0.0;
    double most = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
        const auto valueOf = [&](const auto& flux, const auto& z) {
            const auto perDepth = inverse(z);
            return fixed * (flux * (perDepth * square(perDepth)));
        };
        density[k] = modelOf(valueOf(arriving.middle.flux[k], depth.middle),
                             valueOf(arriving.wide.flux[k], depth.wide));
        if (!density[k].isFinite()) return giveUp(ray, may, {alongOf(ray, may)});
        const double largest = std::max(density[k].range().hi, 0.0);
        most = std::max(most, largest * ray.weight[k].hi);
        worst = std::max(worst, density[k].rest.width() / std::max(largest, 1e-300));
    }
    const double wide = std::max(x.rest.width(), y.rest.width());
    const double area = areaOf(may);
    if (!isFinal && most * area > kSmallIrradiance * tracer.irradianceScale_ &&
        (wide > tracer.settings_.bandPixels || worst > 4.0 * tracer.settings_.bandPixels)) {
        return false;
    }
    found.deposited = found.deposited + watts;

    const auto lineFor = [&](double slopeX, double slopeY, double value, double low, double high) {
        const Interval rest =
            Interval(slopeX) * x.rest + Interval(slopeY) * y.rest + Interval(low, high);
        const double rounded = 1e-14 * (std::fabs(value) + std::fabs(x.value) + std::fabs(y.value));
        return HalfPlane{
            value + slopeX * x.value + slopeY * y.value, slopeX * x.slope[0] + slopeY * y.slope[0],
            slopeX * x.slope[1] + slopeY * y.slope[1], rest.lo - rounded, rest.hi + rounded};
    };
    std::vector<HalfPlane> lines;
    for (int v = top; v <= bottom; ++v) {
        for (int u = left; u <= last; ++u) {
            const std::size_t pixel =
                static_cast<std::size_t>(v) * static_cast<std::size_t>(eye.width()) +
                static_cast<std::size_t>(u);
            std::array<Interval, 3> sum;
            bool any = false;
            for (const SeenPart& part1 : eye.parts(pixel)) {
                if (part1.facet != target.facet) continue;
                lines.clear();
                if (part1.isWhole) {
                    lines.push_back(lineFor(1.0, 0.0, -u, 0.0, 0.0));
                    lines.push_back(lineFor(-1.0, 0.0, u + 1.0, 0.0, 0.0));
                    lines.push_back(lineFor(0.0, 1.0, -v, 0.0, 0.0));
                    lines.push_back(lineFor(0.0, -1.0, v + 1.0, 0.0, 0.0));
                } else {
                    for (const HalfPlane& edge : part1.edges)
                        lines.push_back(
                            lineFor(edge.slopeX, edge.slopeY, edge.value, edge.low, edge.high));
                }
                const Side side = part1.isSure ? Side::inner : Side::outer;
                for (Polygon polygon : part1.isSure ? sure : may) {
                    for (const HalfPlane& line : lines)
                        polygon.cut(line, side);
                    if (polygon.isEmpty()) continue;
                    any = true;
                    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
                        const double value =
                            std::max(part(density[k], polygon, !part1.isSure), 0.0);
                        double& bound = part1.isSure ? sum[k].lo : sum[k].hi;
                        bound = part1.isSure ? rounding::down(bound + value)
                                             : rounding::up(bound + value);
                    }
                }
            }
            if (!any) continue;
            Deposit add{pixel, {}};
            for (std::size_t k = 0; k < 3; ++k) {
                const Interval& value = sum[channels == 1 ? 0 : k];
                add.irradiance[k] = {
                    std::max(rounding::down(std::max(value.lo, 0.0) * ray.weight[k].lo), 0.0),
                    rounding::up(std::max(value.hi, 0.0) * ray.weight[k].hi)};
            }
            found.deposits.push_back(add);
        }
    }
    return true;
}

void BeamTracer::Work::split(const Cell& cell) {
    if (traceCell(cell)) {
        sums.countCells(1);
        sums.addEmitted(found.emitted);
        sums.addDeposited(found.deposited);
        sums.addLimited(found.limited);
        for (const Deposit& add : found.deposits)
            sums.addPixel(add.pixel, add.irradiance);
        for (const Lost& lost : found.undecided)
            sums.addUndecided(lost.facet, lost.watts);
        for (const Open& open : found.open)
            addOpen(open);
        sums.addLost(found.lost);
        return;
    }
    if (cell.depth > tracer.settings_.maxDepth + 8)
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
    split({at(0.0, 0.0), {halfX, halfY}, depth});
    split({at(0.5, 0.0), {halfX, halfY}, depth});
    split({at(0.0, 0.5), {halfX, halfY}, depth});
    split(
        {at(0.5, 0.5),
         {std::array<double, 2>{-halfX[0], -halfX[1]}, std::array<double, 2>{-halfY[0], -halfY[1]}},
         depth});
}

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
        const Vec away = a - exact(source.position);
        const Interval near =
            source.isDistant ? Interval(1.0)
                             : Interval(1.0) / (square(away.x) + square(away.y) + square(away.z));
        std::array<double, 3> watts;
        for (std::size_t c = 0; c < 3; ++c)
            watts[c] = rounding::up(closing.magnitude() * power[c].hi * (near.hi + 1.0) * 10.0);
        sums.addEmitted({0.0, Work::meanOf(watts)});
        sums.addDeposited({0.0, Work::meanOf(watts)});
        sums.addUndecided(facets, watts);
        return;
    }
    Work work{*this, geometry_, eye_, source, first, sums, geometry_.absorbs() ? 3 : 1,
              power, false,     0.0,  {},     {}};
    work.findShadows();
    work.split({{0.0, 0.0}, {std::array<double, 2>{1.0, 0.0}, std::array<double, 2>{0.0, 1.0}}, 0});
}

}  // namespace kaustik::certify
