// SPDX-License-Identifier: MIT
// Area, volume and soundness of a triangle mesh, measured in double from its triangles alone.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <utility>

#include "framework/scene/scene.h"

namespace kaustik::scene::test {

inline std::array<glm::dvec3, 3> corners(const Mesh& mesh, const glm::uvec3& triangle) {
    return {glm::dvec3(mesh.positions[triangle.x]), glm::dvec3(mesh.positions[triangle.y]),
            glm::dvec3(mesh.positions[triangle.z])};
}

inline double area(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const auto [a, b, c] = corners(mesh, triangle);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

// By the divergence theorem: positive when the triangles face outwards.
inline double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const auto [a, b, c] = corners(mesh, triangle);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

// How often each undirected edge is used, by the position of its ends.
inline std::map<int, int> edgeUses(const Mesh& mesh) {
    using Point = std::array<float, 3>;
    const auto point = [&](std::uint32_t vertex) {
        const glm::vec3& p = mesh.positions[vertex];
        return Point{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // -0 becomes 0
    };
    std::map<std::pair<Point, Point>, int> uses;
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const Point from = point(triangle[corner]);
            const Point to = point(triangle[(corner + 1) % 3]);
            ++uses[from < to ? std::pair(from, to) : std::pair(to, from)];
        }
    }
    std::map<int, int> histogram;
    for (const auto& [edge, count] : uses)
        ++histogram[count];
    return histogram;
}

inline bool everyEdgeHasTwoTriangles(const Mesh& mesh) {
    const std::map<int, int> uses = edgeUses(mesh);
    return uses.size() == 1 && uses.begin()->first == 2;
}

// Arrays of one length, indices in range, unit normals on the side that the triangles show, and no
// triangle without area.
inline void expectSound(const Mesh& mesh) {
    ASSERT_FALSE(mesh.triangles.empty());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (const glm::vec3& normal : mesh.normals) {
        // Three roundings to 24 bits: at most 1.5 ulp of 1.
        ASSERT_NEAR(glm::length(glm::dvec3(normal)), 1.0, 2e-7);
    }
    for (const glm::uvec3& triangle : mesh.triangles) {
        const auto [a, b, c] = corners(mesh, triangle);
        const glm::dvec3 face = glm::cross(b - a, c - a);
        ASSERT_GT(glm::length(face), 0.0);
        for (int corner = 0; corner < 3; ++corner) {
            ASSERT_LT(triangle[corner], mesh.positions.size());
            ASSERT_GT(glm::dot(face, glm::dvec3(mesh.normals[triangle[corner]])), 0.0);
        }
    }
}

// What an n-gon in a circle has of the circle's area; also of any solid of revolution's volume.
inline double polygonShare(double n) {
    const double step = 2.0 * 3.14159265358979323846 / n;
    return std::sin(step) / step;
}

}  // namespace kaustik::scene::test
