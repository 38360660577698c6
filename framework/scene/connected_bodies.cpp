// SPDX-License-Identifier: MIT
#include "framework/scene/connected_bodies.h"

#include <algorithm>
#include <map>
#include <optional>

#include "framework/scene/light_paths.h"
#include "framework/scene/surface_rays.h"
#include "framework/scene/triangles.h"

namespace kaustik::scene {
namespace {

// How often a ray goes through surfaces is odd from within; of a ray through an edge, both
// triangles' hits may count, so that two of three rays decide.
bool isInside(const SurfaceRays& rays, const glm::dvec3& point, double size) {
    int votes = 0;
    for (const glm::dvec3& towards : {glm::dvec3(0.31, 0.83, 0.47), glm::dvec3(-0.71, 0.23, 0.67),
                                      glm::dvec3(0.13, -0.59, -0.8)}) {
        const glm::dvec3 direction = glm::normalize(towards);
        glm::dvec3 origin = point;
        bool isOdd = false;
        while (const auto hit = rays.first(origin, direction)) {
            isOdd = !isOdd;
            // Beyond rounding, so that the same triangle is not hit again.
            origin = hit->position + 1e-9 * (size + glm::length(hit->position)) * direction;
        }
        votes += isOdd ? 1 : 0;
    }
    return votes >= 2;
}

class Connections {
  public:
    explicit Connections(const Scene& scene) : scene_(scene) {}

    bool areConnected(std::size_t one, std::size_t other) {
        const Bounds first = objectBounds(scene_, scene_.objects[one]);
        const Bounds second = objectBounds(scene_, scene_.objects[other]);
        if (!overlap(first, second)) return false;
        return edgeCrosses(one, other) || edgeCrosses(other, one) ||
               isInside(raysOf(other), aCornerOf(one),
                        glm::length(second.maximum - second.minimum)) ||
               isInside(raysOf(one), aCornerOf(other), glm::length(first.maximum - first.minimum));
    }

  private:
    const SurfaceRays& raysOf(std::size_t object) {
        const auto found = rays_.find(object);
        if (found != rays_.end()) return found->second;
        return rays_.emplace(object, SurfaceRays(scene_, {object})).first->second;
    }

    [[nodiscard]] glm::dvec3 aCornerOf(std::size_t object) const {
        const Object& whose = scene_.objects[object];
        const Mesh& mesh = scene_.meshes[whose.mesh];
        return cornersOf(mesh, mesh.triangles.front(), whose.toWorld)[0];
    }

    // Whether an edge of the first one's triangles goes through a triangle of the other.
    bool edgeCrosses(std::size_t one, std::size_t other) {
        const Object& object = scene_.objects[one];
        const Bounds box = objectBounds(scene_, scene_.objects[other]);
        const SurfaceRays& rays = raysOf(other);
        const Mesh& mesh = scene_.meshes[object.mesh];
        for (const glm::uvec3& triangle : mesh.triangles) {
            const auto corners = cornersOf(mesh, triangle, object.toWorld);
            for (std::size_t i = 0; i < 3; ++i) {
                const glm::dvec3& from = corners[i];
                const glm::dvec3& to = corners[(i + 1) % 3];
                const double length = glm::length(to - from);
                if (!(length > 0.0) ||
                    !overlap({glm::min(from, to), glm::max(from, to), false}, box))
                    continue;
                if (rays.isBlocked(from, (to - from) / length, length)) return true;
            }
        }
        return false;
    }

    const Scene& scene_;
    std::map<std::size_t, SurfaceRays> rays_;
};

}  // namespace

std::vector<std::vector<std::size_t>> connectedBodies(const Scene& scene) {
    Connections connections(scene);
    std::vector<std::vector<std::size_t>> bodies;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (scene.materials[object.material].kind != MaterialKind::dielectric ||
            scene.meshes[object.mesh].triangles.empty() || isOpen(scene, object.material))
            continue;
        // All that it is connected with become one with the first of them.
        std::vector<std::size_t>* whole = nullptr;
        for (std::vector<std::size_t>& body : bodies) {
            if (std::none_of(body.begin(), body.end(),
                             [&](std::size_t other) { return connections.areConnected(i, other); }))
                continue;
            if (whole == nullptr) {
                whole = &body;
                body.push_back(i);
            } else {
                whole->insert(whole->end(), body.begin(), body.end());
                body.clear();
            }
        }
        if (whole == nullptr) {
            bodies.push_back({i});
        } else {
            std::sort(whole->begin(), whole->end());
        }
        std::erase_if(bodies, [](const auto& body) { return body.empty(); });
    }
    return bodies;
}

}  // namespace kaustik::scene
