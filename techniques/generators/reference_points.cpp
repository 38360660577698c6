// SPDX-License-Identifier: MIT
#include "techniques/generators/reference_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "framework/scene/triangles.h"

namespace kaustik {
namespace {

constexpr int kRays = 512;
// A receiver that is seen at a smaller sine has texels ten times as long as wide, and counts as not
// seen.
constexpr double kMinSlant = 0.1;
// By how much more another place must see than the middle to be taken: rays tell no less.
constexpr double kMinGain = 0.05;

double radiusOf(const scene::Bounds& bounds) {
    return 0.5 * glm::length(bounds.maximum - bounds.minimum);
}

bool contains(const scene::Bounds& outer, const scene::Bounds& inner) {
    const glm::dvec3 slack(1e-9 * radiusOf(outer));
    return glm::all(glm::lessThanEqual(outer.minimum - slack, inner.minimum)) &&
           glm::all(glm::greaterThanEqual(outer.maximum + slack, inner.maximum));
}

struct SurfaceTriangle {
    std::array<glm::dvec3, 3> corners;
    bool isOpen = false;  // light leaves it where it has come to it, else anywhere
    bool isMirror = false;
    double areaUpTo = 0.0;  // of all triangles up to this one, m²
};

std::vector<SurfaceTriangle> surfaceOf(const scene::Scene& scene, const scene::Bounds& generator) {
    std::vector<SurfaceTriangle> triangles;
    double area = 0.0;
    for (const scene::Object& object : scene.objects) {
        if (isReceiver(scene.materials[object.material].kind)) continue;
        const scene::Bounds bounds = objectBounds(scene, object);
        if (bounds.empty || !contains(generator, bounds)) continue;
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        for (const glm::uvec3& indices : mesh.triangles) {
            SurfaceTriangle triangle;
            triangle.corners = scene::cornersOf(mesh, indices, object.toWorld);
            area += 0.5 * glm::length(glm::cross(triangle.corners[1] - triangle.corners[0],
                                                 triangle.corners[2] - triangle.corners[0]));
            triangle.areaUpTo = area;
            triangle.isOpen = !mesh.closed;
            triangle.isMirror =
                scene.materials[object.material].kind == scene::MaterialKind::mirror;
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

// The i-th point of a sequence that fills the unit cube evenly: multiples of the powers of the
// inverse of the root of x^6 = x + 1.
double evenly(int i, int dimension) {
    return std::fmod(0.5 + i / std::pow(1.1347241384015194, dimension + 1), 1.0);
}

// By Lambert's cosine about a unit normal, of two numbers below 1.
glm::dvec3 aroundNormal(const glm::dvec3& normal, double u, double v) {
    const glm::dvec3 other = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 along = glm::normalize(glm::cross(normal, other));
    const double sine = std::sqrt(u);
    const double turn = 2.0 * std::numbers::pi * v;
    return sine * std::cos(turn) * along + sine * std::sin(turn) * glm::cross(normal, along) +
           std::sqrt(1.0 - u) * normal;
}

// Where light comes from to a point, unit; nothing where receivers keep it from all lights.
std::optional<glm::dvec3> towardsLight(const glm::dvec3& point, const scene::Scene& scene,
                                       const scene::SurfaceRays& receivers) {
    for (const scene::Light& light : scene.lights) {
        if (light.kind == scene::LightKind::directional) {
            if (!receivers.isBlocked(point, -light.direction)) return -light.direction;
            continue;
        }
        const glm::dvec3 offset = light.position - point;
        const double distance = glm::length(offset);
        if (!(distance > 0.0)) continue;
        const glm::dvec3 direction = offset / distance;
        if (light.kind == scene::LightKind::spot &&
            glm::dot(-direction, light.direction) <
                std::cos(static_cast<double>(light.outerConeRadians))) {
            continue;
        }
        if (!receivers.isBlocked(point, direction, distance)) return direction;
    }
    return std::nullopt;
}

// Of light that a dielectric sheet sends on, how much is looked for where it reflects it.
constexpr double kReflectedShare = 0.125;

bool sees(const glm::dvec3& point, const ReachedPlace& place, const scene::SurfaceRays& receivers) {
    const glm::dvec3 offset = place.position - point;
    const double distance = glm::length(offset);
    if (!(distance > 0.0)) return false;
    const glm::dvec3 direction = offset / distance;
    const double slant = glm::dot(place.normal, direction);
    // From the side that light comes to.
    if (slant * glm::dot(place.normal, place.position - place.from) <= 0.0) return false;
    if (std::abs(slant) < kMinSlant) return false;
    return !receivers.isBlocked(point, direction, (1.0 - 1e-4) * distance);
}

double seenShare(const glm::dvec3& point, const std::vector<ReachedPlace>& places,
                 const scene::SurfaceRays& receivers) {
    if (places.empty()) return 1.0;
    const auto seen = std::count_if(places.begin(), places.end(), [&](const ReachedPlace& place) {
        return sees(point, place, receivers);
    });
    return static_cast<double>(seen) / static_cast<double>(places.size());
}

// Where a part may be looked at from, the best known place first.
std::vector<glm::dvec3> candidates(const scene::Bounds& bounds) {
    const glm::dvec3 extent = bounds.maximum - bounds.minimum;
    const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
    int thin = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (extent[axis] < extent[thin]) thin = axis;
    }
    const int along = (thin + 1) % 3;
    const int across = (thin + 2) % 3;
    const double wide = std::min(extent[along], extent[across]);
    std::vector<glm::dvec3> points;
    if (extent[thin] >= 0.1 * wide) {
        points.push_back(middle);
        for (int i = 0; i < 27; ++i) {
            if (i == 13) continue;
            const glm::dvec3 corner(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            points.push_back(middle + 0.35 * corner * extent);
        }
        return points;
    }
    // Rings of a spiral out to a quarter of the sheet.
    for (const double side :
         {bounds.maximum[thin] + 0.1 * wide, bounds.minimum[thin] - 0.1 * wide}) {
        for (int i = 0; i < 13; ++i) {
            const double turn = 2.399963229728653 * i;
            const double reach = 0.25 * std::sqrt(i / 12.0);
            glm::dvec3 point = middle;
            point[thin] = side;
            point[along] += reach * std::cos(turn) * extent[along];
            point[across] += reach * std::sin(turn) * extent[across];
            points.push_back(point);
        }
    }
    return points;
}

std::vector<scene::Bounds> split(const scene::Bounds& whole, int points) {
    std::vector<scene::Bounds> parts{whole};
    while (parts.size() < static_cast<std::size_t>(points)) {
        const auto largest = std::max_element(parts.begin(), parts.end(),
                                              [](const scene::Bounds& a, const scene::Bounds& b) {
                                                  return radiusOf(a) < radiusOf(b);
                                              });
        const glm::dvec3 extent = largest->maximum - largest->minimum;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                         : extent.y >= extent.z                       ? 1
                                                                      : 2;
        scene::Bounds second = *largest;
        const double middle = 0.5 * (largest->minimum[axis] + largest->maximum[axis]);
        largest->maximum[axis] = middle;
        second.minimum[axis] = middle;
        parts.push_back(second);
    }
    return parts;
}

bool isIn(const scene::Bounds& bounds, const glm::dvec3& point) {
    return glm::all(glm::lessThanEqual(bounds.minimum, point)) &&
           glm::all(glm::greaterThanEqual(bounds.maximum, point));
}

}  // namespace

std::vector<ReachedPlace> placesReached(const scene::Scene& scene, const scene::Bounds& generator,
                                        const scene::SurfaceRays& receivers) {
    const std::vector<SurfaceTriangle> triangles = surfaceOf(scene, generator);
    std::vector<ReachedPlace> places;
    if (triangles.empty()) return places;
    for (int i = 0; i < kRays; ++i) {
        const double area = evenly(i, 0) * triangles.back().areaUpTo;
        const auto found = std::lower_bound(
            triangles.begin(), triangles.end(), area,
            [](const SurfaceTriangle& triangle, double upTo) { return triangle.areaUpTo < upTo; });
        if (found == triangles.end()) continue;
        const std::array<glm::dvec3, 3>& corners = found->corners;
        const double root = std::sqrt(evenly(i, 1));
        const double share = evenly(i, 2);
        const glm::dvec3 from = (1.0 - root) * corners[0] + root * (1.0 - share) * corners[1] +
                                root * share * corners[2];
        const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(glm::length(cross) > 0.0)) continue;
        glm::dvec3 normal = glm::normalize(cross);
        if (found->isOpen) {
            const std::optional<glm::dvec3> light = towardsLight(from, scene, receivers);
            if (!light) continue;
            const bool isReflected = found->isMirror || evenly(i, 3) < kReflectedShare;
            if ((glm::dot(normal, *light) > 0.0) != isReflected) normal = -normal;
        }
        const glm::dvec3 direction = aroundNormal(normal, evenly(i, 4), evenly(i, 5));
        if (const auto hit = receivers.first(from, direction))
            places.push_back({from, hit->position, hit->normal});
    }
    return places;
}

ReferencePoints referencePoints(const scene::Bounds& generator,
                                const std::vector<ReachedPlace>& reached,
                                const scene::SurfaceRays& receivers, int pointCount) {
    ReferencePoints result;
    double seen = 0.0;
    std::vector<ReachedPlace> left = reached;
    for (const scene::Bounds& bounds : split(generator, pointCount)) {
        const auto own = std::partition(left.begin(), left.end(), [&](const ReachedPlace& place) {
            return !isIn(bounds, place.from);
        });
        const std::vector<ReachedPlace> places(own, left.end());
        left.erase(own, left.end());
        GeneratorPart part{bounds};
        const std::vector<glm::dvec3> points = candidates(bounds);
        part.reference = points.front();
        double best = seenShare(part.reference, places, receivers);
        const double ofFirst = best;
        for (std::size_t i = 1; i < points.size() && ofFirst < 1.0 - kMinGain; ++i) {
            const double share = seenShare(points[i], places, receivers);
            if (share <= std::max(best, ofFirst + kMinGain)) continue;
            best = share;
            part.reference = points[i];
        }
        seen += best * static_cast<double>(places.size());
        result.parts.push_back(part);
    }
    if (!reached.empty()) result.seenShare = seen / static_cast<double>(reached.size());
    return result;
}

}  // namespace kaustik
