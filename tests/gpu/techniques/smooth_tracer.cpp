// SPDX-License-Identifier: MIT
#include "tests/gpu/techniques/smooth_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaustik::test {
namespace {

using glm::dvec2;
using glm::dvec3;
using Distance = std::optional<double>;
using Accepts = std::function<bool(const dvec3&)>;

constexpr double kNearest = 1e-7;

// The smaller root of a t² + 2 b t + c = 0 beyond kNearest at which the ray is on the surface.
Distance firstRoot(double a, double b, double c, const Ray& ray, const Accepts& accepts) {
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0.0) || a == 0.0) return {};
    const double half = std::sqrt(discriminant);
    for (const double t : {(-b - half) / a, (-b + half) / a}) {
        if (t > kNearest && accepts(ray.origin + t * ray.direction)) return t;
    }
    return {};
}

SmoothSurface sphere(const dvec3& center, double radius, const Accepts& accepts) {
    return {[=](const Ray& ray) {
                const dvec3 from = ray.origin - center;
                return firstRoot(1.0, glm::dot(from, ray.direction),
                                 glm::dot(from, from) - radius * radius, ray, accepts);
            },
            [=](const dvec3& p) { return (p - center) / radius; }};
}

// The side of a cylinder about the y axis; side -1: seen from within.
SmoothSurface tube(const dvec3& center, double radius, double height, double side) {
    return {
        [=](const Ray& ray) {
            const dvec2 from(ray.origin.x - center.x, ray.origin.z - center.z);
            const dvec2 along(ray.direction.x, ray.direction.z);
            return firstRoot(glm::dot(along, along), glm::dot(from, along),
                             glm::dot(from, from) - radius * radius, ray, [=](const dvec3& p) {
                                 return std::abs(p.y - center.y) < 0.5 * height;
                             });
        },
        [=](const dvec3& p) { return side / radius * dvec3(p.x - center.x, 0.0, p.z - center.z); }};
}

// At a height; `up`: 1 or -1, the way it faces.
SmoothSurface level(double height, double up, const Accepts& accepts) {
    return {[=](const Ray& ray) -> Distance {
                const double t = (height - ray.origin.y) / ray.direction.y;
                if (!(t > kNearest) || !std::isfinite(t)) return {};
                return accepts(ray.origin + t * ray.direction) ? Distance(t) : Distance();
            },
            [=](const dvec3&) { return dvec3(0.0, up, 0.0); }};
}

SmoothScene of(Optics optics, double index, SmoothScene surfaces) {
    for (SmoothSurface& surface : surfaces) {
        surface.optics = optics;
        surface.index = index;
    }
    return surfaces;
}

dvec2 waveVector(const SmoothWave& wave) {
    const double angle = wave.directionDegrees * std::numbers::pi / 180.0;
    return 2.0 * std::numbers::pi / wave.wavelength * dvec2(std::cos(angle), std::sin(angle));
}

// Nothing where the ray cannot be refracted.
std::optional<dvec3> refracted(const dvec3& direction, const dvec3& normal, double index) {
    const double side = glm::dot(direction, normal) < 0.0 ? 1.0 : -1.0;
    const double eta = side > 0.0 ? 1.0 / index : index;
    const double cosine = -side * glm::dot(direction, normal);
    const double beyond = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if (!(beyond > 0.0)) return {};
    return glm::normalize(eta * direction + (eta * cosine - std::sqrt(beyond)) * side * normal);
}

}  // namespace

SmoothScene smoothFloor(double height) {
    return {level(height, 1.0, [](const dvec3&) { return true; })};
}

SmoothScene smoothBall(const dvec3& center, double radius, double index) {
    return of(Optics::glass, index, {sphere(center, radius, [](const dvec3&) { return true; })});
}

SmoothScene smoothLens(const SmoothLens& lens, double index) {
    const auto cap = [&](double radius, double up) {
        const dvec3 middle = lens.center + up * dvec3(0.0, 0.5 * lens.thickness - radius, 0.0);
        const double rim = 0.5 * lens.diameter;
        return sphere(middle, radius, [=](const dvec3& p) {
            return up * (p.y - middle.y) > 0.0 && std::hypot(p.x - middle.x, p.z - middle.z) < rim;
        });
    };
    const auto sagitta = [&](double radius) {
        return radius - std::sqrt(radius * radius - 0.25 * lens.diameter * lens.diameter);
    };
    const double above = 0.5 * lens.thickness - sagitta(lens.topRadius);
    const double below = 0.5 * lens.thickness - sagitta(lens.bottomRadius);
    const dvec3 middle = lens.center + dvec3(0.0, 0.5 * (above - below), 0.0);
    return of(Optics::glass, index,
              {cap(lens.topRadius, 1.0), cap(lens.bottomRadius, -1.0),
               tube(middle, 0.5 * lens.diameter, above + below, 1.0)});
}

SmoothScene smoothCylinder(const dvec3& center, double radius, double height, double index) {
    const Accepts isOnCap = [=](const dvec3& p) {
        return std::hypot(p.x - center.x, p.z - center.z) < radius;
    };
    return of(Optics::glass, index,
              {tube(center, radius, height, 1.0), level(center.y + 0.5 * height, 1.0, isOnCap),
               level(center.y - 0.5 * height, -1.0, isOnCap)});
}

SmoothScene smoothRing(const dvec3& center, double innerRadius, double outerRadius, double height) {
    const Accepts isBetween = [=](const dvec3& p) {
        const double r = std::hypot(p.x - center.x, p.z - center.z);
        return r > innerRadius && r < outerRadius;
    };
    return of(Optics::mirror, 1.0,
              {tube(center, outerRadius, height, 1.0), tube(center, innerRadius, height, -1.0),
               level(center.y + 0.5 * height, 1.0, isBetween),
               level(center.y - 0.5 * height, -1.0, isBetween)});
}

SmoothScene smoothWaves(const std::vector<SmoothWave>& waves, double side, double index) {
    const auto heightAt = [waves](const dvec3& p) {
        double height = 0.0;
        for (const SmoothWave& wave : waves)
            height += wave.amplitude * std::cos(glm::dot(waveVector(wave), dvec2(p.x, p.z)));
        return height;
    };
    const auto normalAt = [waves](const dvec3& p) {
        dvec2 slope(0.0);
        for (const SmoothWave& wave : waves) {
            const dvec2 k = waveVector(wave);
            slope -= wave.amplitude * std::sin(glm::dot(k, dvec2(p.x, p.z))) * k;
        }
        return glm::normalize(dvec3(-slope.x, 1.0, -slope.y));
    };
    // Newton's method from the plane that the waves go up and down from.
    const auto distance = [=](const Ray& ray) -> Distance {
        double t = -ray.origin.y / ray.direction.y;
        for (int i = 0; i < 50; ++i) {
            const dvec3 p = ray.origin + t * ray.direction;
            const dvec3 normal = normalAt(p);
            const double step = (p.y - heightAt(p)) * normal.y / glm::dot(normal, ray.direction);
            t -= step;
            if (std::abs(step) < 1e-15) break;
        }
        const dvec3 p = ray.origin + t * ray.direction;
        const bool isOn = std::abs(p.y - heightAt(p)) < 1e-12 && std::abs(p.x) < 0.5 * side &&
                          std::abs(p.z) < 0.5 * side;
        return isOn && t > kNearest ? Distance(t) : Distance();
    };
    return of(Optics::glass, index, {SmoothSurface{distance, normalAt}});
}

std::vector<SmoothHit> followPath(const SmoothScene& scene, Ray ray,
                                  const std::vector<bool>& reflected) {
    std::vector<SmoothHit> hits;
    while (true) {
        double nearest = 1e30;
        SmoothHit hit;
        for (std::size_t i = 0; i < scene.size(); ++i) {
            const Distance t = scene[i].distance(ray);
            if (!t || *t >= nearest) continue;
            nearest = *t;
            hit.surface = i;
        }
        if (nearest == 1e30) return hits;
        const SmoothSurface& surface = scene[hit.surface];
        hit.position = ray.origin + nearest * ray.direction;
        hit.normal = surface.normal(hit.position);
        const double slant = glm::dot(ray.direction, hit.normal);
        hit.cosine = std::abs(slant);
        hit.next = {hit.position, glm::reflect(ray.direction, hit.normal)};
        const std::size_t interaction = hits.size();
        if (surface.optics == Optics::receiver || interaction == reflected.size()) {
            hits.push_back(hit);
            return hits;
        }
        if (!reflected[interaction]) {
            const std::optional<dvec3> beyond =
                surface.optics == Optics::mirror
                    ? std::nullopt
                    : refracted(ray.direction, hit.normal, surface.index);
            if (!beyond) return hits;
            hit.next.direction = *beyond;
            hit.cosine = std::min(hit.cosine, std::abs(glm::dot(*beyond, hit.normal)));
        }
        hits.push_back(hit);
        ray = hit.next;
    }
}

}  // namespace kaustik::test
