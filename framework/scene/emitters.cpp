// SPDX-License-Identifier: MIT
#include "framework/scene/emitters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <memory>

#include "framework/scene/basis.h"
#include "framework/scene/emitting_environment.h"
#include "framework/scene/pixel_size.h"
#include "framework/scene/spectrum.h"
#include "framework/scene/triangles.h"

namespace kaustik::scene {
namespace {

constexpr int kUsualRows = 600;
constexpr int kSkyPoints = 64;
constexpr int kPoints = 16;  // at most, and of a bulb
// Of a part of the sky; to first order more means nothing, rad.
constexpr double kMaxSpread = 0.3;
// What two points that are neighbours do to light at most, in pixels: about a quarter of it where
// it arrives. Closer ones cost more photons of each than they bring (results/lamps.md).
constexpr double kPixelsApart = 16.0;

bool emits(const Material& material) {
    return material.emission != glm::vec3(0.0f);
}

double radiusOfDisc(double area) {
    return std::sqrt(area / glm::pi<double>());
}

// Even over the unit disc, in a spiral of the golden angle (Vogel 1979), moved so that their mean
// is the middle: one point is there.
std::vector<glm::dvec2> pointsOnDisc(int count) {
    const double goldenAngle = glm::pi<double>() * (3.0 - std::sqrt(5.0));
    std::vector<glm::dvec2> points;
    glm::dvec2 sum(0.0);
    for (int i = 0; i < count; ++i) {
        const double turn = goldenAngle * i;
        points.push_back(std::sqrt((i + 0.5) / count) * glm::dvec2(std::cos(turn), std::sin(turn)));
        sum += points.back();
    }
    for (glm::dvec2& point : points)
        point -= sum / static_cast<double>(count);
    return points;
}

Light pointOfDisc(const Light& sun, const glm::dvec2& place, int count) {
    const double edge = std::tan(0.5 * static_cast<double>(sun.angularDiameterRadians));
    const Basis across = basisAround(sun.direction);
    Light point = sun;
    point.angularDiameterRadians = 0.0f;
    point.direction =
        glm::normalize(sun.direction + edge * (place.x * across.a + place.y * across.b));
    // Together they make on what faces the middle what the whole does.
    const double cosine = glm::dot(point.direction, sun.direction);
    point.power = glm::vec3(glm::dvec3(sun.power) / (count * cosine));
    point.radius = static_cast<float>(edge / std::sqrt(count));
    return point;
}

Light pointOfSurface(const EmittingSurface::Point& at, double areaSquareMeters,
                     const glm::vec3& radiance) {
    Light point;
    point.kind = LightKind::surface;
    point.position = at.position;
    point.direction = at.normal;
    point.power = glm::vec3(glm::dvec3(radiance) * areaSquareMeters);
    point.radius = static_cast<float>(radiusOfDisc(areaSquareMeters));
    return point;
}

glm::dvec3 middleOf(const Bounds& bounds) {
    return 0.5 * (bounds.minimum + bounds.maximum);
}

// The angle that an emitter takes of the sight of the scene's specular surfaces, about.
double angleOf(const Scene& scene, const Emitter& emitter, const Bounds& specular) {
    if (emitter.environment) return glm::pi<double>();
    if (!emitter.object) return static_cast<double>(emitter.light.angularDiameterRadians);
    const Bounds bounds = objectBounds(scene, scene.objects[*emitter.object]);
    const double distance = std::max(
        glm::length(middleOf(bounds) - middleOf(specular)) - 0.5 * diagonalOf(specular), 1e-9);
    return std::min(diagonalOf(bounds) / distance, glm::pi<double>());
}

bool isLevel(const Scene& scene, const Emitter& emitter) {
    return !emitter.object || EmittingSurface(scene, scene.objects[*emitter.object]).isLevel();
}

}  // namespace

EmittingSurface::EmittingSurface(const Scene& scene, const Object& object) {
    const Mesh& mesh = scene.meshes[object.mesh];
    // What is mirrored faces the other way.
    const bool isMirrored = glm::determinant(glm::dmat3(object.toWorld)) < 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        Corners corners = cornersOf(mesh, triangle, object.toWorld);
        if (isMirrored) std::swap(corners[1], corners[2]);
        triangles_.push_back(corners);
    }
    double area = 0.0;
    for (const Corners& corners : triangles_) {
        area += glm::length(areaOf(corners));
        cumulated_.push_back(area);
    }
}

bool EmittingSurface::isLevel() const {
    glm::dvec3 whole(0.0);
    for (const Corners& corners : triangles_)
        whole += areaOf(corners);
    return glm::length(whole) > 0.5 * areaSquareMeters();
}

// Halves the range along the longest side of its middles until a part is left.
void EmittingSurface::addMiddles(Range range, int parts, std::vector<Point>& all) {
    const auto [begin, end] = range;
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    glm::dvec3 middle(0.0);
    glm::dvec3 facing(0.0);
    double area = 0.0;
    for (const Corners* t = begin; t != end; ++t) {
        const double own = glm::length(areaOf(*t));
        low = glm::min(low, middleOf(*t));
        high = glm::max(high, middleOf(*t));
        middle += own * middleOf(*t);
        facing += areaOf(*t);
        area += own;
    }
    if (parts <= 1 || end - begin < 2) {
        const Corners* const nearest =
            std::min_element(begin, end, [&](const Corners& one, const Corners& other) {
                return glm::distance(middleOf(one), middle / area) <
                       glm::distance(middleOf(other), middle / area);
            });
        const double size = glm::length(facing);
        const glm::dvec3 normal = size > 0.0 ? facing / size : glm::dvec3(0, 1, 0);
        for (int i = 0; i < parts; ++i)
            all.push_back({middleOf(*nearest), normal});
        return;
    }
    const glm::dvec3 extent = high - low;
    const glm::length_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                               : extent.y >= extent.z                       ? 1
                                                                            : 2;
    std::sort(begin, end, [&](const Corners& one, const Corners& other) {
        return middleOf(one)[axis] < middleOf(other)[axis];
    });
    const int first = parts / 2;
    double before = 0.0;
    Corners* split = begin;
    while (split + 1 != end && before < area * first / parts)
        before += glm::length(areaOf(*split++));
    addMiddles({begin, split}, first, all);
    addMiddles({split, end}, parts - first, all);
}

std::vector<EmittingSurface::Point> EmittingSurface::middles(int parts) const {
    // No triangle is more than a part of a part.
    constexpr double kPieces = 16.0;
    const double maximum = areaSquareMeters() / (kPieces * std::max(parts, 1));
    std::vector<Corners> pieces;
    std::vector<Corners> waiting = triangles_;
    while (!waiting.empty()) {
        const Corners t = waiting.back();
        waiting.pop_back();
        const double own = glm::length(areaOf(t));
        if (!(own > 0.0)) continue;
        if (own <= maximum) {
            pieces.push_back(t);
            continue;
        }
        const glm::dvec3 ab = 0.5 * (t[0] + t[1]);
        const glm::dvec3 bc = 0.5 * (t[1] + t[2]);
        const glm::dvec3 ca = 0.5 * (t[2] + t[0]);
        waiting.insert(waiting.end(),
                       {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    std::vector<Point> all;
    if (!pieces.empty()) addMiddles({pieces.data(), pieces.data() + pieces.size()}, parts, all);
    return all;
}

EmittingSurface::Point EmittingSurface::at(double which, double u, double v) const {
    if (triangles_.empty()) return {};
    const auto found =
        std::upper_bound(cumulated_.begin(), cumulated_.end(), which * cumulated_.back());
    const auto index =
        std::min(static_cast<std::size_t>(found - cumulated_.begin()), triangles_.size() - 1);
    const Corners& t = triangles_[index];
    const double root = std::sqrt(u);
    const glm::dvec3 normal = areaOf(t);
    const double size = glm::length(normal);
    return {(1.0 - root) * t[0] + root * (1.0 - v) * t[1] + root * v * t[2],
            size > 0.0 ? normal / size : glm::dvec3(0, 1, 0)};
}

void findEmitters(Scene& scene) {
    std::shared_ptr<const EmittingEnvironment> environment;
    for (const Emitter& emitter : scene.emitters) {
        if (emitter.environment) environment = emitter.environment;
    }
    std::erase_if(scene.emitters, [](const Emitter& emitter) { return !emitter.isDisc(); });
    const auto hasDisc = [](const Light& light) { return light.angularDiameterRadians > 0.0f; };
    // Where an edit has taken a disc away.
    for (const Emitter& emitter : scene.emitters) {
        if (!hasDisc(emitter.light)) scene.lights.push_back(emitter.light);
    }
    std::erase_if(scene.emitters, [&](const Emitter& emitter) { return !hasDisc(emitter.light); });
    for (const Light& light : scene.lights) {
        if (hasDisc(light)) scene.emitters.push_back({light, {}});
    }
    std::erase_if(scene.lights, hasDisc);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (emits(scene.materials[object.material]))
            scene.emitters.push_back({{}, static_cast<std::uint32_t>(i)});
    }
    if (scene.environmentLights) {
        if (!environment) environment = std::make_shared<const EmittingEnvironment>(scene);
        scene.emitters.push_back({{}, {}, environment});
    }
    placeLightPoints(scene, 0, kUsualRows);
}

EmitterPoints pointsOf(const Scene& scene, const Emitter& emitter, int wanted, int rows) {
    EmitterPoints points;
    const Bounds all = sceneBounds(scene);
    Bounds specular = specularBounds(scene);
    if (specular.empty) specular = all;
    if (all.empty || rows < 1) return points;
    // As far as light can go on from there within the scene.
    points.blurMeters =
        2.0 * std::tan(0.5 * std::min(angleOf(scene, emitter, specular), 3.0)) * diagonalOf(all);
    points.pixelMeters = pixelMeters(scene, rows);
    if (wanted > 0) {
        points.points = wanted;
    } else if (emitter.environment) {
        points.points = kSkyPoints;
    } else if (!isLevel(scene, emitter)) {
        points.points = kPoints;
    } else {
        const double apart = points.blurMeters / (kPixelsApart * points.pixelMeters);
        points.points =
            static_cast<int>(std::lround(std::clamp(apart * apart, 1.0, kPoints + 0.0)));
    }
    return points;
}

void placeLightPoints(Scene& scene, int wanted, int rows) {
    forgetBands(scene);
    std::erase_if(scene.lights, [](const Light& light) { return light.emitter >= 0; });
    for (std::size_t e = 0; e < scene.emitters.size(); ++e) {
        const Emitter& emitter = scene.emitters[e];
        const int count = pointsOf(scene, emitter, wanted, rows).points;
        const std::string name = nameOf(scene, emitter);
        const auto add = [&](Light point, int index) {
            point.name = fmt::format("{} {}/{}", name, index + 1, count);
            point.emitter = static_cast<int>(e);
            scene.lights.push_back(std::move(point));
        };
        if (emitter.isDisc()) {
            const std::vector<glm::dvec2> places = pointsOnDisc(count);
            for (int i = 0; i < count; ++i)
                add(pointOfDisc(emitter.light, places[static_cast<std::size_t>(i)], count), i);
            continue;
        }
        if (emitter.environment) {
            int index = 0;
            for (const EmittingEnvironment::Part& part : emitter.environment->parts(count)) {
                Light point;
                point.direction = -part.direction;
                point.power = glm::vec3(part.fluxPerSquareMeter);
                point.radius = static_cast<float>(std::min(part.radius, kMaxSpread));
                add(std::move(point), index++);
            }
            continue;
        }
        const Object& object = scene.objects[*emitter.object];
        const EmittingSurface surface(scene, object);
        const std::vector<EmittingSurface::Point> middles = surface.middles(count);
        for (std::size_t i = 0; i < middles.size(); ++i) {
            add(pointOfSurface(middles[i], surface.areaSquareMeters() / count,
                               scene.materials[object.material].emission),
                static_cast<int>(i));
        }
    }
}

int mostLightPoints(const Scene& scene) {
    std::vector<int> counts(scene.emitters.size(), 0);
    for (const Light& light : scene.lights) {
        if (light.band > 0) continue;
        if (light.emitter < 0) return 1;
        ++counts[static_cast<std::size_t>(light.emitter)];
    }
    return counts.empty() ? 1 : std::max(*std::max_element(counts.begin(), counts.end()), 1);
}

std::string nameOf(const Scene& scene, const Emitter& emitter) {
    if (emitter.environment) return "environment";
    return emitter.object ? scene.objects[*emitter.object].name : emitter.light.name;
}

}  // namespace kaustik::scene
