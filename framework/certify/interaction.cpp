// SPDX-License-Identifier: MIT
// What happens to light at a specular facet: the laws of reference/optics.h and the reference's
// rules for normals (reference/README), each where it holds for all of the cell; else the light is
// given up, or the cell is split.
#include <algorithm>
#include <optional>
#include <vector>

#include "framework/certify/cell_tracer.h"
#include "framework/certify/reach.h"

namespace kaustik::certify {
namespace {

// Where the squared cosine of the refracted angle is below that share of its largest value in the
// cell, its root has no derivatives that are worth anything.
constexpr double kCriticalShare = 0.1;
// Below this cosine of incidence the shares of light at the critical angle are not looked at.
constexpr double kSmallestCosine = 1e-3;

template <bool s>
struct Bent {
    Vector<Jet<s>> refracted;
    Jet<s> reflectance;
};

template <bool s>
[[nodiscard]] Vector<Jet<s>> normalized(const Vector<Jet<s>>& v) {
    return scaled(inverse(sqrt(squaredLength(v))), v);
}

// `incidence`: the cosine; `root`: of the refracted angle, squared.
template <bool s>
[[nodiscard]] Bent<s> refract(const Vector<Jet<s>>& along, const Vector<Jet<s>>& normal,
                              const Jet<s>& incidence, const Jet<s>& root, const Interval& eta) {
    Bent<s> result;
    const Jet<s> exit = sqrt(root);
    const Jet<s> slowed = eta * incidence;
    result.refracted = scaled(eta, along) + scaled(slowed - exit, normal);
    const Jet<s> a = (slowed - exit) * inverse(slowed + exit);
    const Jet<s> b = (incidence - eta * exit) * inverse(incidence + eta * exit);
    result.reflectance = Interval(0.5) * (square(a) + square(b));
    return result;
}

template <bool s>
[[nodiscard]] Jet<s> refractedRoot(const Jet<s>& incidence, const Interval& eta) {
    return (square(eta) * square(incidence)) + (Interval(1.0) - square(eta));
}

template <bool s>
[[nodiscard]] Vector<Jet<s>> reflect(const Vector<Jet<s>>& along, const Vector<Jet<s>>& normal,
                                     const Jet<s>& incidence) {
    return along + scaled(Interval(2.0) * incidence, normal);
}

// A unit normal, on the light's side.
struct Normals {
    Vector<Jet<true>> wide;
    Vector<Jet<false>> middle;
};

class Interaction {
  public:
    Interaction(CellTracer& tracer, const Ray& ray, std::uint32_t at, bool enters)
        : tracer_(tracer),
          ray_(ray),
          own_(tracer.geometry().facets()[at]),
          material_(tracer.geometry().scene().materials[own_.material]),
          isMirror_(own_.kind == scene::MaterialKind::mirror),
          enters_(enters),
          geometric_(enters ? own_.area : negated(own_.area)),
          next_(ray) {
        const Interval inside(static_cast<double>(material_.ior));
        eta_ = enters ? Interval(1.0) / inside : inside;
        next_.start = at;
        next_.interactions = ray.interactions + 1;
    }

    bool follow(const Both& b, const Both& c) {
        const Vector<Jet<true>> wideNormal = interpolated(b.wide, c.wide);
        // The reference moves a normal that is short or on the other side of its triangle; such a
        // surface is given up.
        if (!(squaredLength(wideNormal).value.lo > 1e-24) ||
            !(dot(wideNormal, geometric_).value.lo > 0.0)) {
            return tracer_.giveUp(ray_, ray_.may, {});
        }
        const Interval perLength = inverse(sqrt(squaredLength(wideNormal).value));
        shadingBox_ = {perLength * wideNormal.x.value, perLength * wideNormal.y.value,
                       perLength * wideNormal.z.value};
        geometricUnit_ = scaled(inverse(sqrt(dot(geometric_, geometric_))), geometric_);
        // Bodies within bodies are given up.
        const std::uint32_t body = own_.material + 1;
        if (!isMirror_ && (enters_ ? ray_.medium != 0 : ray_.medium != body))
            return tracer_.giveUp(ray_, ray_.may, {});
        // Which normal bends the light: the interpolated one, unless it would send it to the wrong
        // side.
        Normals shading{normalized(wideNormal), normalized(interpolated(b.middle, c.middle))};
        narrow(shading.middle, shading.wide);
        if (!followBy(shading, true)) return false;
        if (ray_.may.empty()) return true;
        return followBy({constant<true>(geometricUnit_), constant<false>(geometricUnit_)}, false);
    }

  private:
    template <bool s>
    [[nodiscard]] Vector<Jet<s>> interpolated(const Jet<s>& u, const Jet<s>& v) const {
        const double side = enters_ ? 1.0 : -1.0;
        const Vec n = exact(side * own_.normal[0]);
        const Vec nb = exact(side * own_.normal[1]) - n;
        const Vec nc = exact(side * own_.normal[2]) - n;
        return {n.x + (nb.x * u + nc.x * v), n.y + (nb.y * u + nc.y * v),
                n.z + (nb.z * u + nc.z * v)};
    }

    // Where light may go that is given up here: by either normal.
    bool giveUpHere() {
        const Vec along = alongOf(ray_, next_.may);
        std::vector<Vec> directions;
        for (const Vec& normal : {shadingBox_, geometricUnit_})
            addDirections(along, normal, eta_, isMirror_, directions);
        return tracer_.giveUpBranches(next_, next_.may, directions,
                                      reflectedBranch() | refractedBranch());
    }

    // Moves what of the light is in the region from `ray_` to `next_`; whether there is any.
    bool take(const Region& region) {
        next_.sure = ray_.sure;
        next_.may = ray_.may;
        if (region.empty()) {
            ray_.sure.clear();
            ray_.may.clear();
            return !next_.may.empty();
        }
        const auto keep = [&](Polygons& polygons, Side side) {
            for (Polygon& polygon : polygons) {
                for (const HalfPlane& line : region)
                    polygon.cut(line, side);
            }
            std::erase_if(polygons, [](const Polygon& polygon) { return polygon.isEmpty(); });
        };
        keep(next_.sure, Side::inner);
        keep(next_.may, Side::outer);
        subtract(ray_.sure, region, Side::outer);
        subtract(ray_.may, region, Side::inner);
        return !next_.may.empty();
    }

    // Adds to the region where this is positive; false where it is nowhere.
    static bool require(const Jet<true>& wide, const Jet<false>& middle, double sign,
                        Region& region) {
        const Interval value = sign > 0.0 ? wide.value : -wide.value;
        if (value.hi <= 0.0) return false;
        if (!(value.lo > 0.0)) region.push_back(lineOf(modelOf(middle, wide), sign));
        return true;
    }

    // Follows what of the light this normal bends, and leaves the rest in `ray_`. `isShading`: the
    // interpolated one, which bends only what it sends to the right side.
    bool followBy(const Normals& normal, bool isShading) {
        isShading_ = isShading;
        const Jet<false> middleIncidence = -dot(ray_.middle.along, normal.middle);
        Jet<true> incidence = -dot(ray_.wide.along, normal.wide);
        narrow(middleIncidence, incidence);
        next_.wide.flux = ray_.wide.flux;
        next_.middle.flux = ray_.middle.flux;
        Region region;
        if (isShading && !require(incidence, middleIncidence, 1.0, region)) return true;
        next_.wide.along = reflect(ray_.wide.along, normal.wide, incidence);
        next_.middle.along = reflect(ray_.middle.along, normal.middle, middleIncidence);
        narrow(next_.middle.along, next_.wide.along);
        if (isShading && !require(dot(next_.wide.along, geometric_),
                                  dot(next_.middle.along, geometric_), 1.0, region))
            return true;
        if (isMirror_) return !take(region) || followMirrored();
        const Jet<false> middleRoot = refractedRoot(middleIncidence, eta_);
        Jet<true> root = refractedRoot(incidence, eta_);
        narrow(middleRoot, root);
        if (root.value.hi <= 0.0) return !take(region) || advanceReflected();
        if (!(root.value.lo > std::max(kCriticalShare * root.value.hi, 1e-9))) {
            return !take(region) ||
                   (incidence.value.lo > kSmallestCosine
                        ? followCritical(normal.wide, incidence.value, root.value, isShading)
                        : giveUpHere());
        }
        Bent<true> wide = refract(ray_.wide.along, normal.wide, incidence, root, eta_);
        const Bent<false> middle =
            refract(ray_.middle.along, normal.middle, middleIncidence, middleRoot, eta_);
        narrow(middle.refracted, wide.refracted);
        narrow(middle.reflectance, wide.reflectance);
        if (isShading && !require(dot(wide.refracted, geometric_),
                                  dot(middle.refracted, geometric_), -1.0, region))
            return true;
        return !take(region) || followBoth(wide, middle);
    }

    // Light near the critical angle of one normal: with e the refracted cosine, from its least to
    // its largest value, the reflected share and the refracted direction.
    struct Critical {
        Interval reflected;
        Vec refracted;
    };
    Critical criticalBy(const Vec& normal, const Interval& cosine, const Interval& root,
                        const Vec& along) const {
        const Interval exit = sqrt(Interval(std::max(root.lo, 0.0), std::max(root.hi, 0.0)));
        const Interval ofS = exit / (eta_ * cosine);
        const Interval ofP = eta_ * exit / cosine;
        const Interval a = (Interval(1.0) - ofS) / (Interval(1.0) + ofS);
        const Interval b = (Interval(1.0) - ofP) / (Interval(1.0) + ofP);
        // Where the root is negative, all is reflected.
        return {{std::max((Interval(0.5) * (square(a) + square(b))).lo, 0.0), 1.0},
                scaled(eta_, along) + scaled(eta_ * cosine - exit, normal)};
    }

    // At the critical angle the refracted direction has no derivative, but hardly any light takes
    // it, and the reflected direction is as smooth as elsewhere: the one is given up, the other
    // followed. Where it is not sure by which normal, the reflected light must be such as ends in
    // the body whatever its direction is.
    bool followCritical(const Vector<Jet<true>>& normal, const Interval& cosine,
                        const Interval& root, bool isShading) {
        const Vec along = alongOf(ray_, next_.may);
        const Vec unit{normal.x.value, normal.y.value, normal.z.value};
        Critical found = criticalBy(unit, cosine, root, along);
        std::vector<Vec> refracted{found.refracted};
        const bool isSure = !isShading || dot(found.refracted, geometric_).hi < 0.0;
        if (!isSure) {
            const Interval own = -dot(along, geometricUnit_);
            if (ray_.interactions == 0 || !(own.lo > kSmallestCosine)) return giveUpHere();
            const Interval ownRoot = square(eta_) * square(own) + (Interval(1.0) - square(eta_));
            const Critical other = criticalBy(geometricUnit_, own, ownRoot, along);
            found.reflected.lo = std::min(found.reflected.lo, other.reflected.lo);
            refracted.push_back(other.refracted);
        }
        Ray lost = next_;
        lost.medium = enters_ ? own_.material + 1 : 0;
        const double factor = tracer_.tracer().planted().fresnelFactor;
        const Interval through(0.0, (Interval(factor) * (Interval(1.0) - found.reflected)).hi);
        for (Interval& weight : lost.weight)
            weight = weight * through;
        if (!tracer_.giveUpBranches(lost, next_.may, refracted, refractedBranch())) return false;
        if (tracer_.tracer().planted().withoutReflection) return true;
        // Of the light of which only the refracted branch is followed what is not all reflected
        // ends here.
        if (tracer_.tracer().settings().transmissionOnly) found.reflected.lo = 0.0;
        const Ray before = next_;
        for (Interval& weight : next_.weight)
            weight = weight * found.reflected;
        if (isSure) return advanceReflected();
        std::vector<Vec> reflected;
        for (const Vec& n : {unit, geometricUnit_})
            addDirections(along, n, eta_, true, reflected);
        if (tracer_.endsInBody(next_, reflected)) return true;
        next_ = before;
        return giveUpHere();
    }

    bool advanceReflected() { return tracer_.advanceBranch(next_, reflectedBranch()); }
    [[nodiscard]] Branch reflectedBranch() const {
        return isShading_ ? kReflected : kReflectedByTriangle;
    }
    [[nodiscard]] Branch refractedBranch() const {
        return isShading_ ? kRefracted : kRefractedByTriangle;
    }

    bool followMirrored() {
        for (std::size_t k = 0; k < 3; ++k) {
            next_.weight[k] = ray_.weight[k] *
                              Interval(static_cast<double>(material_.albedo[static_cast<int>(k)]));
        }
        return advanceReflected();
    }

    // A share of what has arrived, whatever the enclosure of the share is.
    static void clampToShare(double largest, const Jet<true>& arrived, Jet<true>& share) {
        const double most = rounding::up(largest * std::max(arrived.value.hi, 0.0));
        share.value.lo = std::max(share.value.lo, 0.0);
        // What is no number stays so.
        if (share.value.hi > most) share.value.hi = most;
    }

    bool followBoth(const Bent<true>& wide, const Bent<false>& middle) {
        const std::size_t used = static_cast<std::size_t>(tracer_.channels());
        const PlantedError& planted = tracer_.tracer().planted();
        Ray through = next_;
        through.medium = enters_ ? own_.material + 1 : 0;
        through.wide.along = wide.refracted;
        through.middle.along = middle.refracted;
        const Interval factor(planted.fresnelFactor);
        for (std::size_t k = 0; k < used; ++k) {
            through.wide.flux[k] =
                factor * (ray_.wide.flux[k] * (Interval(1.0) - wide.reflectance));
            through.middle.flux[k] =
                factor * (ray_.middle.flux[k] * (Interval(1.0) - middle.reflectance));
            clampToShare(factor.hi, ray_.wide.flux[k], through.wide.flux[k]);
        }
        if (!tracer_.advanceBranch(through, refractedBranch())) return false;
        if (tracer_.tracer().settings().transmissionOnly || planted.withoutReflection) return true;
        for (std::size_t k = 0; k < used; ++k) {
            next_.wide.flux[k] = ray_.wide.flux[k] * wide.reflectance;
            next_.middle.flux[k] = ray_.middle.flux[k] * middle.reflectance;
            clampToShare(1.0, ray_.wide.flux[k], next_.wide.flux[k]);
        }
        return advanceReflected();
    }

    CellTracer& tracer_;
    Ray ray_;  // what of the light is still to be followed
    const Facet& own_;
    const scene::Material& material_;
    bool isMirror_;
    bool enters_;
    bool isShading_ = true;
    Interval eta_;
    Vec geometric_;      // on the light's side, of any length
    Vec geometricUnit_;  // the same, unit
    Vec shadingBox_;     // encloses the interpolated unit normal
    Ray next_;
};

}  // namespace

bool interact(CellTracer& tracer, const Ray& ray, std::uint32_t facet, bool enters, const Both& b,
              const Both& c) {
    return Interaction(tracer, ray, facet, enters).follow(b, c);
}

}  // namespace kaustik::certify
