// SPDX-License-Identifier: MIT
#include "framework/scene/meshes/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "framework/scene/triangles.h"

namespace kaustik::scene {
namespace {

using Corners = std::array<glm::dvec3, 3>;

Corners ownCorners(const Mesh& mesh, const glm::uvec3& triangle) {
    return cornersOf(mesh, triangle, glm::dmat4(1.0));
}

// Of a triangle as seen from the origin, positive from behind (van Oosterom, Strackee 1983).
double exactSolidAngle(const Corners& t) {
    const double a = glm::length(t[0]);
    const double b = glm::length(t[1]);
    const double c = glm::length(t[2]);
    const double volume = glm::dot(t[0], glm::cross(t[1], t[2]));
    const double rest =
        a * b * c + glm::dot(t[0], t[1]) * c + glm::dot(t[1], t[2]) * a + glm::dot(t[2], t[0]) * b;
    if (volume == 0.0 && rest <= 0.0) return 0.0;  // the origin lies in it: as much on either side
    return 2.0 * std::atan2(volume, rest);
}

// From afar a triangle is as good as its area at its middle.
struct Patch {
    Corners corners;
    glm::dvec3 middle;
    glm::dvec3 area;
    double farSquared;  // from here on, m²
};

std::vector<Patch> patchesOf(const Mesh& mesh) {
    constexpr double kFar = 6.0;  // in the longest edges of a triangle: off by 1 % of what it adds
    std::vector<Patch> patches;
    patches.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        const Corners t = ownCorners(mesh, triangle);
        const double longest = std::max(
            {glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
        patches.push_back({t, middleOf(t), areaOf(t), kFar * kFar * longest * longest});
    }
    return patches;
}

double windingNumber(const std::vector<Patch>& patches, const glm::dvec3& point,
                     std::size_t leftOut) {
    double sum = 0.0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const Patch& patch = patches[i];
        const glm::dvec3 there = patch.middle - point;
        const double squared = glm::dot(there, there);
        if (squared > patch.farSquared) {
            sum += glm::dot(patch.area, there) / (squared * std::sqrt(squared));
        } else if (i != leftOut) {
            sum += exactSolidAngle(
                {patch.corners[0] - point, patch.corners[1] - point, patch.corners[2] - point});
        }
    }
    return sum / (4.0 * glm::pi<double>());
}

}  // namespace

double windingNumber(const Mesh& mesh, const glm::dvec3& point) {
    return windingNumber(patchesOf(mesh), point, mesh.triangles.size());
}

double meanWindingBehind(const Mesh& mesh) {
    constexpr std::size_t kPoints = 64;
    const std::vector<Patch> patches = patchesOf(mesh);
    double total = 0.0;
    for (const Patch& patch : patches)
        total += glm::length(patch.area);
    if (!(total > 0.0)) return 0.5;
    double sum = 0.0;
    double before = 0.0;  // area of the triangles up to `at`
    std::size_t at = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double wanted = (static_cast<double>(i) + 0.5) / kPoints * total;
        while (at + 1 < patches.size() && before + glm::length(patches[at].area) <= wanted)
            before += glm::length(patches[at++].area);
        // Anywhere in it: two multiples of irrational numbers, folded into a triangle.
        const double number = static_cast<double>(i) + 1.0;
        double u = std::fmod(0.7548776662466927 * number, 1.0);
        double v = std::fmod(0.5698402909980532 * number, 1.0);
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const Corners& t = patches[at].corners;
        const glm::dvec3 point = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
        // Its own triangle is half of what is seen from just behind it.
        sum += 0.5 + windingNumber(patches, point, at);
    }
    return sum / kPoints;
}

bool boundsVolume(double windingBehind) {
    return std::abs(windingBehind - 0.5) >= 0.25;
}

bool turnsBack(const Mesh& mesh) {
    // A height over each point has no way back.
    if (mesh.heightField) return false;
    constexpr double kShare = 1e-3;
    glm::dvec3 mean(0.0);
    for (const glm::uvec3& triangle : mesh.triangles)
        mean += areaOf(ownCorners(mesh, triangle));
    double away = 0.0;
    double total = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 area = areaOf(ownCorners(mesh, triangle));
        total += glm::length(area);
        if (glm::dot(area, mean) < 0.0) away += glm::length(area);
    }
    return away > kShare * total;
}

}  // namespace kaustik::scene
