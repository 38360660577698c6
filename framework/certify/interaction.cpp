// SPDX-License-Identifier: MIT
// What happens to light at a specular facet: the laws of reference/optics.h and the reference's
// rules for normals (reference/README), each where it holds for all of the cell; else the light is
// given up, or the cell is split.
#include <algorithm>
#include <optional>
#include <vector>

#include "framework/certify/cell_tracer.h"

namespace kaustik::certify {
namespace {

template <bool s>
struct Branch {
    Vector<Jet<s>> refracted;
    Jet<s> reflectance;
};

template <bool s>
[[nodiscard]] Vector<Jet<s>> normalized(const Vector<Jet<s>>& v) {
    return scaled(inverse(sqrt(squaredLength(v))), v);
}

// `incidence`: the cosine; `root`: of the refracted angle, squared.
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
        const Interval geometricLength =
            sqrt(square(geometric_.x) + square(geometric_.y) + square(geometric_.z));
        geometricUnit_ = scaled(inverse(geometricLength), geometric_);
        // Which normal bends the light: the interpolated one, unless it would send it to the wrong
        // side.
        const Normals shading{normalized(wideNormal), normalized(interpolated(b.middle, c.middle))};
        if (const std::optional<bool> done = followBy(shading, true)) return *done;
        const Normals flat{constant<true>(geometricUnit_), constant<false>(geometricUnit_)};
        if (const std::optional<bool> done = followBy(flat, false)) return *done;
        return giveUpHere();
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
        const Vec along = alongOf(ray_, ray_.may);
        std::vector<Vec> directions;
        for (const Vec& normal : {shadingBox_, geometricUnit_}) {
            Interval cosine = -dot(along, normal);
            if (cosine.hi < 0.0) continue;
            cosine.lo = std::max(cosine.lo, 0.0);
            directions.push_back(along + scaled(Interval(2.0) * cosine, normal));
            if (isMirror_) continue;
            Interval root = Interval(1.0) - square(eta_) * (Interval(1.0) - square(cosine));
            if (root.hi < 0.0) continue;
            root.lo = std::max(root.lo, 0.0);
            directions.push_back(scaled(eta_, along) + scaled(eta_ * cosine - sqrt(root), normal));
        }
        return tracer_.giveUp(next_, ray_.may, directions);
    }

    // By one normal; nothing where it is surely not the one. `isShading`: the interpolated one,
    // after which the other is tried.
    std::optional<bool> followBy(const Normals& normal, bool isShading) {
        const Jet<true> incidence = -dot(ray_.wide.along, normal.wide);
        if (isShading && incidence.value.hi <= 0.0) return std::nullopt;
        if (!(incidence.value.lo > 0.0)) return giveUpHere();
        const Jet<false> middleIncidence = -dot(ray_.middle.along, normal.middle);
        next_.wide.along = reflect(ray_.wide.along, normal.wide, incidence);
        next_.middle.along = reflect(ray_.middle.along, normal.middle, middleIncidence);
        const Interval outwards = dot(next_.wide.along, geometric_).value;
        const bool isReflectedWrong = isShading && outwards.hi <= 0.0;
        const bool isReflectedOpen = isShading && !(outwards.lo > 0.0);
        if (isMirror_) {
            if (isReflectedWrong) return std::nullopt;
            if (isReflectedOpen) return giveUpHere();
            return followMirrored();
        }
        // Bodies within bodies are given up.
        const std::uint32_t body = own_.material + 1;
        if (enters_ ? ray_.medium != 0 : ray_.medium != body)
            return tracer_.giveUp(ray_, ray_.may, {});
        const Jet<true> root = refractedRoot(incidence, eta_);
        if (root.value.hi <= 0.0) {
            if (isReflectedWrong) return std::nullopt;
            if (isReflectedOpen) return giveUpHere();
            return tracer_.advance(next_);
        }
        if (!(root.value.lo > 1e-9)) return giveUpHere();
        const Branch<true> wide = refract(ray_.wide.along, normal.wide, incidence, root, eta_);
        const Interval inwards = dot(wide.refracted, geometric_).value;
        if (isReflectedWrong || (isShading && inwards.lo >= 0.0)) return std::nullopt;
        if (isReflectedOpen || (isShading && !(inwards.hi < 0.0))) return giveUpHere();
        return followBoth(wide, refract(ray_.middle.along, normal.middle, middleIncidence,
                                        refractedRoot(middleIncidence, eta_), eta_));
    }

    bool followMirrored() {
        for (std::size_t k = 0; k < 3; ++k) {
            next_.weight[k] = ray_.weight[k] *
                              Interval(static_cast<double>(material_.albedo[static_cast<int>(k)]));
        }
        return tracer_.advance(next_);
    }

    bool followBoth(const Branch<true>& wide, const Branch<false>& middle) {
        const std::size_t used = static_cast<std::size_t>(tracer_.channels());
        Ray through = next_;
        through.medium = enters_ ? own_.material + 1 : 0;
        through.wide.along = wide.refracted;
        through.middle.along = middle.refracted;
        const Interval planted(tracer_.tracer().planted().fresnelFactor);
        for (std::size_t k = 0; k < used; ++k) {
            through.wide.flux[k] =
                planted * (ray_.wide.flux[k] * (Interval(1.0) - wide.reflectance));
            through.middle.flux[k] =
                planted * (ray_.middle.flux[k] * (Interval(1.0) - middle.reflectance));
            // A share of what has arrived, whatever the enclosure of the share is.
            through.wide.flux[k].value.lo = std::max(through.wide.flux[k].value.lo, 0.0);
        }
        if (!tracer_.advance(through)) return false;
        if (tracer_.tracer().settings().transmissionOnly) return true;
        for (std::size_t k = 0; k < used; ++k) {
            next_.wide.flux[k] = ray_.wide.flux[k] * wide.reflectance;
            next_.middle.flux[k] = ray_.middle.flux[k] * middle.reflectance;
            next_.wide.flux[k].value.lo = std::max(next_.wide.flux[k].value.lo, 0.0);
        }
        return tracer_.advance(next_);
    }

    CellTracer& tracer_;
    const Ray& ray_;
    const Facet& own_;
    const scene::Material& material_;
    bool isMirror_;
    bool enters_;
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
