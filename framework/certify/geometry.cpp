// SPDX-License-Identifier: MIT
#include "framework/certify/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <optional>

#include "framework/core/error.h"
#include "framework/scene/spectrum.h"

namespace kaustik::certify {
namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw ConfigError(fmt::format("certify: {} cannot be certified.", what));
}

void requireCertifiable(const scene::Scene& scene) {
    if (scene.medium) refuse("light in a medium that fills the scene");
    if (!scene.bands.empty() || scene::disperses(scene)) refuse("light that disperses");
    if (!scene.emitters.empty())
        refuse("light of sources that have a size (discs, surfaces, environments)");
    for (const scene::Light& light : scene.lights) {
        if (light.kind != scene::LightKind::directional && light.kind != scene::LightKind::point)
            refuse(
                fmt::format("light '{}', which is neither directional nor a point,", light.name));
        if (light.rangeMeters > 0.0f) refuse(fmt::format("the range of light '{}'", light.name));
    }
    for (const scene::Material& material : scene.materials) {
        if (material.normalMap >= 0)
            refuse(fmt::format("the normal map of material '{}'", material.name));
    }
}

// The corners of two triangles that are one rectangle-like convex quadrilateral in a plane along
// the axes, in order.
std::optional<std::array<glm::dvec3, 4>> quadOf(const std::array<glm::dvec3, 3>& a,
                                                const std::array<glm::dvec3, 3>& b) {
    int axis = -1;
    for (int i = 0; i < 3; ++i) {
        bool same = true;
        for (const auto* triangle : {&a, &b}) {
            for (const glm::dvec3& p : *triangle)
                same = same && p[i] == a[0][i];
        }
        if (same) axis = i;
    }
    if (axis < 0) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& p = a[i];
        const glm::dvec3& q = a[(i + 1) % 3];
        for (std::size_t j = 0; j < 3; ++j) {
            if (b[j] != q || b[(j + 1) % 3] != p) continue;
            const std::array<glm::dvec3, 4> quad{p, b[(j + 2) % 3], q, a[(i + 2) % 3]};
            // Strictly convex, so that corners are corners.
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            double sign = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                const glm::dvec3 one = quad[(k + 1) % 4] - quad[k];
                const glm::dvec3 two = quad[(k + 2) % 4] - quad[(k + 1) % 4];
                const double turn = one[u] * two[v] - one[v] * two[u];
                if (std::abs(turn) < 1e-9 * glm::length(one) * glm::length(two))
                    return std::nullopt;
                if (sign * turn < 0.0) return std::nullopt;
                sign = turn;
            }
            return quad;
        }
    }
    return std::nullopt;
}

}  // namespace

Geometry::Geometry(const scene::Scene& scene) : scene_(scene) {
    requireCertifiable(scene);
    const scene::Bounds world = sceneBounds(scene);
    if (!world.empty) center_ = 0.5 * (world.minimum + world.maximum);
    for (const scene::Object& object : scene.objects)
        addObject(object);
    double size = 0.0;
    for (const Facet& facet : facets_) {
        for (std::size_t i = 0; i < facet.corners; ++i) {
            const glm::dvec3 a = glm::abs(facet.position[i]);
            size = std::max({size, a.x, a.y, a.z});
        }
    }
    const glm::dvec3 eye = glm::abs(scene.camera.position - center_);
    size_ = std::max({size, eye.x, eye.y, eye.z, 1e-6});
    for (const scene::Light& light : scene.lights) {
        if (light.emitter >= 0 || light.band != 0) continue;
        Source source;
        source.name = light.name;
        source.power = light.power;
        source.isDistant = light.kind == scene::LightKind::directional;
        if (source.isDistant) {
            const Vec along = exact(light.direction);
            const Interval length = sqrt(square(along.x) + square(along.y) + square(along.z));
            source.direction = scaled(inverse(length), along);
        } else {
            source.position = light.position - center_;
        }
        sources_.push_back(source);
    }
    for (const scene::Material& material : scene.materials)
        absorbs_ = absorbs_ || material.absorptionPerMeter != glm::vec3(0.0f);
    build();
}

void Geometry::addFacet(Facet facet) {
    const Vec a = exact(facet.position[0]);
    facet.area = cross(exact(facet.position[1]) - a, exact(facet.position[2]) - a);
    const glm::dvec3 normal =
        glm::cross(facet.position[1] - facet.position[0], facet.position[2] - facet.position[0]);
    // Nothing can hit what has no area.
    if (!(glm::length(normal) > 0.0)) return;
    facet.unit = glm::normalize(normal);
    facet.unitError = 2.0 * (facet.area.x.width() + facet.area.y.width() + facet.area.z.width()) /
                      glm::length(normal);
    facets_.push_back(facet);
}

// As EmbreeScene::addObject has it.
void Geometry::addObject(const scene::Object& object) {
    const scene::Mesh& mesh = scene_.meshes[object.mesh];
    const glm::dmat4 toLocal = glm::translate(glm::dmat4(1.0), -center_) * object.toWorld *
                               glm::translate(glm::dmat4(1.0), mesh.origin);
    const glm::dmat3 normalToLocal = glm::transpose(glm::inverse(glm::dmat3(toLocal)));
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        positions.emplace_back(glm::vec3(toLocal * glm::dvec4(mesh.positions[i], 1.0)));
        normals.emplace_back(glm::vec3(normalToLocal * glm::dvec3(mesh.normals[i])));
    }
    Facet like;
    like.object = static_cast<std::uint32_t>(&object - scene_.objects.data());
    like.material = object.material;
    like.kind = scene_.materials[object.material].kind;
    like.isClosed = mesh.closed;
    if (like.isReceiver()) return addReceivers(positions, mesh.triangles, like);
    for (const glm::uvec3& triangle : mesh.triangles) {
        Facet facet = like;
        for (glm::length_t i = 0; i < 3; ++i) {
            facet.position[static_cast<std::size_t>(i)] = positions[triangle[i]];
            facet.normal[static_cast<std::size_t>(i)] = normals[triangle[i]];
        }
        addFacet(facet);
    }
}

void Geometry::addReceivers(const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles, const Facet& like) {
    const auto cornersOf = [&](std::size_t i) {
        const glm::uvec3& t = triangles[i];
        return std::array<glm::dvec3, 3>{positions[t.x], positions[t.y], positions[t.z]};
    };
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Facet facet = like;
        const std::array<glm::dvec3, 3> corners = cornersOf(i);
        if (i + 1 < triangles.size()) {
            if (const auto quad = quadOf(corners, cornersOf(i + 1))) {
                facet.corners = 4;
                facet.position = *quad;
                addFacet(facet);
                ++i;
                continue;
            }
        }
        std::copy(corners.begin(), corners.end(), facet.position.begin());
        addFacet(facet);
    }
}

void Geometry::build() {
    const double margin = kNear * size_;
    for (const Facet& facet : facets_) {
        Box box;
        for (std::size_t i = 0; i < facet.corners; ++i)
            box.include(facet.position[i]);
        box.low -= margin;
        box.high += margin;
        boxes_.push_back(box);
    }
    order_.resize(facets_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) addNode(0, order_.size());
}

void Geometry::addNode(std::size_t first, std::size_t end) {
    Node node;
    for (std::size_t i = first; i < end; ++i) {
        node.box.include(boxes_[order_[i]].low);
        node.box.include(boxes_[order_[i]].high);
    }
    const std::size_t at = nodes_.size();
    nodes_.push_back(node);
    if (end - first <= 4) {
        nodes_[at].first = static_cast<std::uint32_t>(first);
        nodes_[at].count = static_cast<std::uint32_t>(end - first);
        return;
    }
    const glm::dvec3 extent = node.box.high - node.box.low;
    const int axis =
        extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
    const std::size_t middle = first + (end - first) / 2;
    const auto begin = order_.begin();
    using Step = std::vector<std::uint32_t>::difference_type;
    std::nth_element(begin + static_cast<Step>(first), begin + static_cast<Step>(middle),
                     begin + static_cast<Step>(end), [&](std::uint32_t a, std::uint32_t b) {
                         return boxes_[a].low[axis] + boxes_[a].high[axis] <
                                boxes_[b].low[axis] + boxes_[b].high[axis];
                     });
    addNode(first, middle);
    nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
    addNode(middle, end);
}

void Geometry::sweep(const Vec& start, const Vec& velocity, double end,
                     const std::function<void(std::uint32_t)>& visit) const {
    if (nodes_.empty()) return;
    const std::array<Interval, 3> from{start.x, start.y, start.z};
    const std::array<Interval, 3> speed{velocity.x, velocity.y, velocity.z};
    // Times at which low + t slope <= limit; those of a hair more, for rounding.
    const auto meets = [&](const Box& box) {
        double first = 0.0;
        double last = end;
        const auto atMost = [&](double low, double slope, double limit) {
            const double room = limit - low + 1e-13 * (std::fabs(limit) + std::fabs(low));
            if (slope > 0.0) {
                last = std::min(last, room / slope * (1.0 + 1e-12) + 1e-300);
            } else if (slope < 0.0) {
                first = std::max(first, room / slope * (1.0 - 1e-12));
            } else if (room < 0.0) {
                last = -1.0;
            }
        };
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            atMost(from[k].lo, speed[k].lo, box.high[i]);
            atMost(-from[k].hi, -speed[k].hi, -box.low[i]);
            if (first > last) return false;
        }
        return true;
    };
    std::array<std::uint32_t, 128> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const Node& node = nodes_[at];
        if (!meets(node.box)) continue;
        if (node.count == 0) {
            stack[depth++] = at + 1;
            stack[depth++] = node.first;
            continue;
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const std::uint32_t facet = order_[node.first + i];
            if (meets(boxes_[facet])) visit(facet);
        }
    }
}

std::vector<glm::dvec3> partBefore(const Facet& facet, const Facet& ground, const glm::dvec3& from,
                                   double size, Side side) {
    const glm::dvec3 base = ground.position[0];
    const double front = glm::dot(ground.unit, from - base) >= 0.0 ? 1.0 : -1.0;
    const double hair = (kNear + 4.0 * ground.unitError) * size;
    const double level = side == Side::inner ? hair : -hair;
    std::array<double, 4> heights{};
    for (std::size_t i = 0; i < facet.corners; ++i)
        heights[i] = front * glm::dot(ground.unit, facet.position[i] - base) - level;
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < facet.corners; ++i) {
        const std::size_t next = (i + 1) % facet.corners;
        if (heights[i] >= 0.0) kept.push_back(facet.position[i]);
        if ((heights[i] >= 0.0) == (heights[next] >= 0.0)) continue;
        const double t = heights[i] / (heights[i] - heights[next]);
        kept.push_back(facet.position[i] + t * (facet.position[next] - facet.position[i]));
    }
    if (kept.size() < 3) kept.clear();
    return kept;
}

}  // namespace kaustik::certify
