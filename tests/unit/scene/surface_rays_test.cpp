// SPDX-License-Identifier: MIT
#include "framework/scene/surface_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "framework/scene/triangles.h"

namespace kaustik::scene {
namespace {

// Three objects of triangles that lie anywhere.
Scene anyTriangles(std::mt19937& random) {
    std::uniform_real_distribution<float> anywhere(-1.0f, 1.0f);
    std::uniform_real_distribution<float> near(-0.15f, 0.15f);
    Scene scene;
    for (std::uint32_t object = 0; object < 3; ++object) {
        Mesh mesh;
        for (std::uint32_t i = 0; i < 200; ++i) {
            const glm::vec3 middle(anywhere(random), anywhere(random), anywhere(random));
            for (int corner = 0; corner < 3; ++corner) {
                mesh.positions.push_back(middle +
                                         glm::vec3(near(random), near(random), near(random)));
            }
            mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        }
        scene.meshes.push_back(mesh);
        scene.objects.push_back({"", object, 0});
    }
    return scene;
}

// Where the ray meets the plane, if that is on the same side of all edges.
std::optional<double> distanceTo(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& origin,
                                 const glm::dvec3& direction) {
    const glm::dvec3 normal = areaOf(corners);
    const double distance = glm::dot(normal, corners[0] - origin) / glm::dot(normal, direction);
    if (!(distance > 0.0)) return {};
    const glm::dvec3 place = origin + distance * direction;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
        if (glm::dot(glm::cross(edge, place - corners[i]), normal) < 0.0) return {};
    }
    return distance;
}

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t object = 0;
};

Nearest nearestOf(const Scene& scene, const std::vector<std::size_t>& objects,
                  const glm::dvec3& origin, const glm::dvec3& direction) {
    Nearest nearest;
    for (const std::size_t object : objects) {
        const Mesh& mesh = scene.meshes[scene.objects[object].mesh];
        for (const glm::uvec3& triangle : mesh.triangles) {
            const auto distance = distanceTo(
                cornersOf(mesh, triangle, scene.objects[object].toWorld), origin, direction);
            if (distance && *distance < nearest.distance) nearest = {*distance, object};
        }
    }
    return nearest;
}

TEST(SurfaceRays, MeetWhatIsNearestOfAllTriangles) {
    std::mt19937 random(7);
    const Scene scene = anyTriangles(random);
    const std::vector<std::size_t> objects = {0, 2};
    const SurfaceRays rays(scene, objects);
    std::normal_distribution<double> normal;
    int hits = 0;
    int misses = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 origin = 0.6 * glm::dvec3(normal(random), normal(random), normal(random));
        // Some along an axis, where a box's faces are parallel to the ray.
        const glm::dvec3 direction =
            i % 10 == 0
                ? glm::dvec3(i % 3 == 0, i % 3 == 1, i % 3 == 2)
                : glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const Nearest nearest = nearestOf(scene, objects, origin, direction);
        const auto hit = rays.first(origin, direction);
        ASSERT_EQ(hit.has_value(), std::isfinite(nearest.distance)) << i;
        EXPECT_EQ(rays.isBlocked(origin, direction), hit.has_value());
        if (!hit) {
            ++misses;
            continue;
        }
        ++hits;
        EXPECT_NEAR(hit->distance, nearest.distance, 1e-9);
        EXPECT_EQ(hit->object, nearest.object);
        EXPECT_NEAR(glm::distance(hit->position, origin), hit->distance, 1e-9);
        EXPECT_FALSE(rays.isBlocked(origin, direction, 0.999 * nearest.distance));
        EXPECT_TRUE(rays.isBlocked(origin, direction, 1.001 * nearest.distance));
    }
    EXPECT_GT(hits, 200);
    EXPECT_GT(misses, 200);
}

TEST(SurfaceRays, OfNoObjectMeetNothing) {
    std::mt19937 random(7);
    const SurfaceRays rays(anyTriangles(random), {});
    EXPECT_FALSE(rays.first(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0)).has_value());
    EXPECT_FALSE(rays.isBlocked(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0)));
}

}  // namespace
}  // namespace kaustik::scene
