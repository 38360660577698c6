// SPDX-License-Identifier: MIT
#include "techniques/generators/generators.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/pipeline/stage_params.h"
#include "techniques/raster_views/light_maps.h"
#include "techniques/raster_views/receivers.h"

namespace kaustik {
namespace {

double radiusOf(const scene::Bounds& bounds) {
    return 0.5 * glm::length(bounds.maximum - bounds.minimum);
}

// Whether direct light may come to a ball around the box; true where that is not certain.
bool mayLight(const scene::Light& light, const scene::Bounds& bounds) {
    if (light.kind == scene::LightKind::directional) return true;
    const glm::dvec3 offset = 0.5 * (bounds.minimum + bounds.maximum) - light.position;
    const double distance = glm::length(offset);
    const double radius = radiusOf(bounds);
    const auto range = static_cast<double>(light.rangeMeters);
    if (range > 0.0 && distance - radius > range) return false;
    if (light.kind == scene::LightKind::point || distance <= radius) return true;
    const double angle =
        std::acos(std::clamp(glm::dot(offset, light.direction) / distance, -1.0, 1.0));
    return angle - std::asin(radius / distance) <= static_cast<double>(light.outerConeRadians);
}

double distanceBetween(const scene::Bounds& a, const scene::Bounds& b) {
    const glm::dvec3 gap =
        glm::max(glm::max(a.minimum - b.maximum, b.minimum - a.maximum), glm::dvec3(0.0));
    return glm::length(gap);
}

void unite(Generator& one, const Generator& other) {
    one.name += fmt::format(", {}", other.name);
    one.bounds.include(other.bounds.minimum);
    one.bounds.include(other.bounds.maximum);
}

// Joins the two nearest until none overlap and there are no more than `maximum`.
void uniteNearest(std::vector<Generator>& all, std::size_t maximum) {
    while (all.size() > 1) {
        double nearest = std::numeric_limits<double>::infinity();
        std::pair<std::size_t, std::size_t> pair{0, 0};
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t j = i + 1; j < all.size(); ++j) {
                const double distance = distanceBetween(all[i].bounds, all[j].bounds);
                if (distance >= nearest) continue;
                nearest = distance;
                pair = {i, j};
            }
        }
        if (nearest > 0.0 && all.size() <= maximum) return;
        unite(all[pair.first], all[pair.second]);
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(pair.second));
    }
}

// In two halves along its longest side, the larger ones first, until there are `points`.
std::vector<Generator> split(const Generator& whole, std::size_t points) {
    std::vector<Generator> parts{whole};
    while (parts.size() < points) {
        const auto largest = std::max_element(parts.begin(), parts.end(),
                                              [](const Generator& a, const Generator& b) {
                                                  return radiusOf(a.bounds) < radiusOf(b.bounds);
                                              });
        const glm::dvec3 extent = largest->bounds.maximum - largest->bounds.minimum;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                         : extent.y >= extent.z                       ? 1
                                                                      : 2;
        Generator second = *largest;
        const double middle = 0.5 * (largest->bounds.minimum[axis] + largest->bounds.maximum[axis]);
        largest->bounds.maximum[axis] = middle;
        second.bounds.minimum[axis] = middle;
        parts.push_back(std::move(second));
    }
    return parts;
}

// How far the nearest receiver is from a point, m.
double distanceToReceivers(const scene::Scene& scene, const glm::dvec3& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const scene::Object& object : scene.objects) {
        if (!isReceiver(scene.materials[object.material].kind)) continue;
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        for (const glm::uvec3& triangle : mesh.triangles) {
            glm::dvec3 corners[3];
            for (int i = 0; i < 3; ++i) {
                corners[i] = glm::dvec3(
                    object.toWorld *
                    glm::dvec4(mesh.origin + glm::dvec3(mesh.positions[triangle[i]]), 1.0));
            }
            const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            const double size = glm::length(normal);
            if (!(size > 0.0)) continue;
            // Of its plane where the point lies over it, else of the nearest corner: near enough.
            bool isOver = true;
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
                isOver = isOver && glm::dot(glm::cross(edge, point - corners[i]), normal) >= 0.0;
                nearest = std::min(nearest, glm::length(point - corners[i]));
            }
            if (isOver)
                nearest = std::min(nearest, std::abs(glm::dot(point - corners[0], normal)) / size);
        }
    }
    return nearest;
}

// Where a generator is looked around from. A sheet has places that receivers leave free, nearest to
// its middle first.
glm::dvec3 referenceOf(const scene::Scene& scene, const scene::Bounds& bounds) {
    const glm::dvec3 extent = bounds.maximum - bounds.minimum;
    glm::dvec3 point = 0.5 * (bounds.minimum + bounds.maximum);
    int thin = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (extent[axis] < extent[thin]) thin = axis;
    }
    const int along = (thin + 1) % 3;
    const int across = (thin + 2) % 3;
    const double wide = std::min(extent[along], extent[across]);
    if (extent[thin] >= 0.1 * wide) return point;
    point[thin] = bounds.maximum[thin] + 0.1 * wide;
    // Of a sheet in or on a wall nothing is better.
    glm::dvec3 best = point;
    double farthest = distanceToReceivers(scene, point);
    for (int i = 1; i < 25 && farthest < 0.1 * wide; ++i) {
        // Rings of a spiral out to a quarter of the sheet.
        const double turn = 2.399963229728653 * i;
        const double reach = 0.25 * std::sqrt(i / 24.0);
        glm::dvec3 other = point;
        other[along] += reach * std::cos(turn) * extent[along];
        other[across] += reach * std::sin(turn) * extent[across];
        const double distance = distanceToReceivers(scene, other);
        if (distance <= farthest) continue;
        farthest = distance;
        best = other;
    }
    return best;
}

// A generator much wider than its receivers are far is seen from one point at grazing angles.
void warnLargeGenerators(FrameBuilder& frame, const std::vector<Generator>& generators,
                         int points) {
    for (const Generator& generator : generators) {
        const double distance = distanceToReceivers(frame.scene(), generator.reference);
        const double radius = radiusOf(generator.bounds);
        if (!(radius > 4.0 * distance)) continue;
        frame.warn(fmt::format(
            "Caustic generator '{}' reaches {:.3g} m around its reference point, {:.1f} times as "
            "far as the nearest receiver is: what that point sees at grazing angles or not at all "
            "is stored coarsely or lost (hidden_in_map); around.points = {} shares it among more.",
            generator.name, radius, radius / std::max(distance, 1e-9), std::min(4 * points, 16)));
        return;
    }
}

// Where nothing is specular nothing leaves anything: rays are looked for from where the eye is.
Generator eyeOf(const scene::Scene& scene) {
    Generator eye{"the eye", {}};
    const glm::dvec3 reach(100.0 * static_cast<double>(scene.camera.nearMeters));
    eye.bounds.include(scene.camera.position - reach);
    eye.bounds.include(scene.camera.position + reach);
    return eye;
}

std::vector<Generator> findGenerators(FrameBuilder& frame, const GeneratorParams& params) {
    const scene::Scene& scene = frame.scene();
    std::vector<Generator> lit;
    std::vector<Generator> all;
    for (const scene::Object& object : scene.objects) {
        const scene::Bounds bounds = objectBounds(scene, object);
        if (isReceiver(scene.materials[object.material].kind) || bounds.empty) continue;
        all.push_back({object.name, bounds});
        if (std::any_of(scene.lights.begin(), scene.lights.end(),
                        [&](const scene::Light& light) { return mayLight(light, bounds); })) {
            lit.push_back(all.back());
        }
    }
    if (lit.empty()) lit = all;
    if (lit.empty()) lit.push_back(eyeOf(scene));
    uniteNearest(lit, static_cast<std::size_t>(params.maxGenerators));
    std::vector<Generator> generators;
    for (const Generator& whole : lit) {
        const std::size_t room = transport::kMaxGenerators - generators.size();
        for (Generator& part :
             split(whole, std::clamp<std::size_t>(static_cast<std::size_t>(params.points), 1,
                                                  std::max<std::size_t>(room, 1)))) {
            if (generators.size() < transport::kMaxGenerators)
                generators.push_back(std::move(part));
        }
    }
    for (Generator& generator : generators)
        generator.reference = referenceOf(scene, generator.bounds);
    warnLargeGenerators(frame, generators, params.points);
    return generators;
}

std::vector<ReceiverView> drawReceivers(FrameBuilder& frame, const Geometry& geometry) {
    const std::vector<Generator>& generators = causticGenerators(frame);
    const int side = sideOfCubeMaps(frame, static_cast<int>(generators.size()));
    std::vector<ReceiverView> receivers;
    for (std::size_t i = 0; i < generators.size(); ++i) {
        const Views views = frame.makeViews(render::Space::cube, facesAround(generators[i], side));
        receivers.push_back(
            renderReceivers(frame, geometry, views, "generator" + suffixOfGenerator(i),
                            fmt::format("generator '{}' stores caustics where it sees receivers",
                                        generators[i].name),
                            render::DrawSet::receivers)
                .receivers);
    }
    return receivers;
}

}  // namespace

const std::vector<Generator>& causticGenerators(FrameBuilder& frame) {
    return *frame.once<std::vector<Generator>>("generators", [&] {
        return std::make_shared<std::vector<Generator>>(
            findGenerators(frame, frame.params<GeneratorParams>("around")));
    });
}

const std::vector<ReceiverView>& generatorReceivers(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<std::vector<ReceiverView>>("generators.receivers", [&] {
        return std::make_shared<std::vector<ReceiverView>>(drawReceivers(frame, geometry));
    });
}

const gl::Buffer& generatorsBlock(FrameBuilder& frame) {
    return *frame.once<gl::Buffer>("generators.block", [&] {
        const glm::dmat4 toWorld = glm::inverse(frame.view().worldToView);
        transport::GeneratorsData data{};
        data.eyeToWorld = glm::mat4(glm::mat3(toWorld));
        const std::vector<Generator>& generators = causticGenerators(frame);
        data.count.x = static_cast<unsigned>(generators.size());
        for (std::size_t i = 0; i < generators.size(); ++i) {
            const scene::Bounds& box = generators[i].bounds;
            const glm::dvec3 eye(toWorld[3]);
            const glm::dvec3 middle = 0.5 * (box.minimum + box.maximum);
            data.centers[i] = glm::vec4(glm::vec3(middle - eye), 0.0f);
            data.references[i] = glm::vec4(glm::vec3(generators[i].reference - eye), 0.0f);
            data.halfExtents[i] = glm::vec4(glm::vec3(0.5 * (box.maximum - box.minimum)), 0.0f);
        }
        return std::make_shared<gl::Buffer>(std::vector<transport::GeneratorsData>{data},
                                            "generators");
    });
}

std::string suffixOfGenerator(std::size_t generator) {
    return generator == 0 ? "" : fmt::format(".{}", generator + 1);
}

std::vector<render::RasterView> facesAround(const Generator& generator, int side) {
    return render::makeCube(generator.reference, 1e-3 * radiusOf(generator.bounds), side);
}

}  // namespace kaustik
