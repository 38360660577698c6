// SPDX-License-Identifier: MIT
// The tree: a trunk that branches and branches again, each branch a tapering tube with its ends
// closed.
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/scene/meshes/mesh_builder.h"
#include "framework/scene/shapes/shape_checks.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

constexpr double kGoldenAngle = 2.39996322972865332;
constexpr double kShorter = 0.68;  // a branch than what it grows from
constexpr double kThinner = 0.6;
constexpr double kTaper = 0.7;  // radius at a branch's end

// [0, 1), the same on every machine (splitmix64).
class Numbers {
  public:
    explicit Numbers(std::uint64_t seed) : state_(seed) {}
    double next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

struct Branch {
    glm::dvec3 base{0.0};
    glm::dvec3 direction{0.0, 1.0, 0.0};  // unit
    double length = 1.0;
    double radius = 0.1;
};

glm::dvec3 perpendicularTo(const glm::dvec3& direction) {
    const glm::dvec3 other =
        std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return glm::normalize(glm::cross(direction, other));
}

void addTube(MeshBuilder& builder, const Branch& branch, unsigned sides) {
    const glm::dvec3 u = perpendicularTo(branch.direction);
    const glm::dvec3 v = glm::cross(branch.direction, u);
    const auto ring = [&](unsigned i, unsigned j) {
        const double angle = 2.0 * glm::pi<double>() * (i % sides) / sides;
        const glm::dvec3 out = std::cos(angle) * u + std::sin(angle) * v;
        const double radius = j == 0 ? branch.radius : kTaper * branch.radius;
        const double slope = (1.0 - kTaper) * branch.radius / branch.length;
        return SurfacePoint{
            branch.base + (j == 0 ? 0.0 : branch.length) * branch.direction + radius * out,
            glm::normalize(out + slope * branch.direction),
            {i * 2.0 * glm::pi<double>() * branch.radius / sides, j * branch.length}};
    };
    builder.addGrid(sides, 1, ring);
    for (unsigned i = 1; i + 1 < sides; ++i) {
        const auto cap = [&](unsigned corner, unsigned j) {
            SurfacePoint point = ring(corner, j);
            point.normal = j == 0 ? -branch.direction : branch.direction;
            return point;
        };
        builder.addTriangle(cap(0, 0), cap(i + 1, 0), cap(i, 0));
        builder.addTriangle(cap(0, 1), cap(i, 1), cap(i + 1, 1));
    }
}

void grow(MeshBuilder& builder, const TreeShape& shape, const Branch& branch, unsigned level,
          double turn, Numbers& numbers) {
    addTube(builder, branch, shape.sides);
    if (level >= shape.levels) return;
    const glm::dvec3 u = perpendicularTo(branch.direction);
    const glm::dvec3 v = glm::cross(branch.direction, u);
    for (unsigned child = 0; child < shape.children; ++child) {
        const double around = turn + child * kGoldenAngle + 0.5 * numbers.next();
        const double lean = glm::radians(shape.spreadDegrees) * (0.6 + 0.8 * numbers.next());
        const double along = child == 0 ? 0.97 : 0.55 + 0.4 * numbers.next();
        Branch next;
        next.base = branch.base + along * branch.length * branch.direction;
        next.direction =
            glm::normalize(std::cos(lean) * branch.direction +
                           std::sin(lean) * (std::cos(around) * u + std::sin(around) * v));
        next.length = branch.length * kShorter * (0.8 + 0.4 * numbers.next());
        next.radius = branch.radius * kThinner;
        grow(builder, shape, next, level + 1, around, numbers);
    }
}

}  // namespace

Mesh makeTree(const TreeShape& shape) {
    requirePositive("height", shape.height);
    requirePositive("trunk_radius", shape.trunkRadius);
    requireCells("sides", shape.sides, 3);
    double branches = 0.0;
    for (unsigned level = 0; level <= shape.levels; ++level)
        branches += std::pow(shape.children, level);
    if (branches * shape.sides > 1e6) {
        throw ConfigError(
            "levels and children make more branches than fit beside a scene: at most "
            "a million sides.");
    }
    // What a trunk and the branches that go on from its end add up to.
    double reach = 0.0;
    for (unsigned level = 0; level <= shape.levels; ++level)
        reach += std::pow(kShorter, level);
    MeshBuilder builder;
    Numbers numbers(shape.seed);
    Branch trunk;
    trunk.length = shape.height / reach;
    trunk.radius = shape.trunkRadius;
    grow(builder, shape, trunk, 0, 0.0, numbers);
    return builder.finish("tree");
}

}  // namespace kaustik::scene
