// SPDX-License-Identifier: MIT
#include "framework/scene/surface_rays.h"

#include <algorithm>
#include <array>
#include <utility>

#include "framework/scene/triangles.h"

namespace kaustik::scene {
namespace {

constexpr std::size_t kTrianglesOfLeaf = 4;

// Where a ray enters the box, m, up to `farthest`.
std::optional<double> distanceToBox(const glm::dvec3& minimum, const glm::dvec3& maximum,
                                    const glm::dvec3& origin, const glm::dvec3& inverse,
                                    double farthest) {
    const glm::dvec3 one = (minimum - origin) * inverse;
    const glm::dvec3 other = (maximum - origin) * inverse;
    const glm::dvec3 near = glm::min(one, other);
    const glm::dvec3 far = glm::max(one, other);
    const double begin = std::max({near.x, near.y, near.z, 0.0});
    const double end = std::min({far.x, far.y, far.z, farthest});
    return begin <= end ? std::optional(begin) : std::nullopt;
}

}  // namespace

std::vector<std::size_t> receiversOf(const Scene& scene) {
    std::vector<std::size_t> receivers;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        if (isReceiver(scene.materials[scene.objects[i].material].kind)) receivers.push_back(i);
    }
    return receivers;
}

SurfaceRays::SurfaceRays(const Scene& scene, const std::vector<std::size_t>& objects) {
    for (const std::size_t i : objects) {
        const Object& object = scene.objects[i];
        const Mesh& mesh = scene.meshes[object.mesh];
        for (const glm::uvec3& indices : mesh.triangles) {
            const auto corners = cornersOf(mesh, indices, object.toWorld);
            triangles_.push_back(
                {corners[0], {corners[1] - corners[0], corners[2] - corners[0]}, i});
        }
    }
    if (!triangles_.empty()) addNode(0, triangles_.size());
}

void SurfaceRays::addNode(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    Node node{glm::dvec3(std::numeric_limits<double>::infinity()),
              glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (std::size_t i = begin; i < end; ++i) {
        const Triangle& triangle = triangles_[i];
        for (const glm::dvec3& corner : {triangle.corner, triangle.corner + triangle.edges[0],
                                         triangle.corner + triangle.edges[1]}) {
            node.minimum = glm::min(node.minimum, corner);
            node.maximum = glm::max(node.maximum, corner);
        }
    }
    const bool isLeaf = end - begin <= kTrianglesOfLeaf;
    node.first = static_cast<std::uint32_t>(begin);
    node.count = isLeaf ? static_cast<std::uint32_t>(end - begin) : 0;
    nodes_.push_back(node);
    if (isLeaf) return;
    const glm::dvec3 extent = node.maximum - node.minimum;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const auto middleOf = [axis](const Triangle& triangle) {
        return 3.0 * triangle.corner[axis] + triangle.edges[0][axis] + triangle.edges[1][axis];
    };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) {
        return triangles_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(middle), at(end), [&](const Triangle& a, const Triangle& b) {
        return middleOf(a) < middleOf(b);
    });
    addNode(begin, middle);
    nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
    addNode(middle, end);
}

// Shortens `farthest` to what is nearest; where any will do, to what is found first.
std::optional<std::size_t> SurfaceRays::hit(const glm::dvec3& origin, const glm::dvec3& direction,
                                            double& farthest, bool isAnyEnough) const {
    if (nodes_.empty()) return {};
    // Finite: on a face of a box nothing times infinity would be no number.
    constexpr double kNoSlope = 1e-200;
    const glm::dvec3 inverse =
        1.0 / glm::mix(direction, glm::dvec3(kNoSlope), glm::equal(direction, glm::dvec3(0.0)));
    // A ray through the edge between two triangles hits one at least.
    constexpr double kEdge = 1e-12;
    // Halves of halves: a tree of 2^32 triangles is 31 levels deep, each of which leaves one node.
    struct Open {
        std::uint32_t node = 0;
        double distance = 0.0;
    };
    std::array<Open, 33> open;
    std::size_t count = 0;
    const auto enter = [&](std::uint32_t index) {
        const Node& node = nodes_[index];
        const auto distance = distanceToBox(node.minimum, node.maximum, origin, inverse, farthest);
        if (distance) open[count++] = {index, *distance};
        return distance.has_value();
    };
    enter(0);
    std::optional<std::size_t> found;
    while (count > 0) {
        const Open next = open[--count];
        if (next.distance > farthest) continue;
        const Node& node = nodes_[next.node];
        if (node.count == 0) {
            const bool isFirst = enter(next.node + 1);
            const bool isSecond = enter(node.first);
            // The nearer one is taken next.
            if (isFirst && isSecond && open[count - 1].distance > open[count - 2].distance)
                std::swap(open[count - 1], open[count - 2]);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Triangle& triangle = triangles_[i];
            const glm::dvec3 cross = glm::cross(direction, triangle.edges[1]);
            const double determinant = glm::dot(triangle.edges[0], cross);
            if (determinant == 0.0) continue;
            const glm::dvec3 offset = origin - triangle.corner;
            const double u = glm::dot(offset, cross) / determinant;
            const glm::dvec3 across = glm::cross(offset, triangle.edges[0]);
            const double v = glm::dot(direction, across) / determinant;
            const double distance = glm::dot(triangle.edges[1], across) / determinant;
            if (u < -kEdge || v < -kEdge || u + v > 1.0 + kEdge || !(distance > 0.0) ||
                distance >= farthest)
                continue;
            farthest = distance;
            found = i;
            if (isAnyEnough) return found;
        }
    }
    return found;
}

std::optional<SurfaceRays::Hit> SurfaceRays::first(const glm::dvec3& origin,
                                                   const glm::dvec3& direction) const {
    double distance = std::numeric_limits<double>::infinity();
    const std::optional<std::size_t> found = hit(origin, direction, distance, false);
    if (!found) return {};
    const Triangle& triangle = triangles_[*found];
    return Hit{distance, origin + distance * direction,
               glm::normalize(glm::cross(triangle.edges[0], triangle.edges[1])), triangle.object};
}

bool SurfaceRays::isBlocked(const glm::dvec3& origin, const glm::dvec3& direction,
                            double farthest) const {
    return hit(origin, direction, farthest, true).has_value();
}

}  // namespace kaustik::scene
