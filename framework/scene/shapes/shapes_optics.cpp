// SPDX-License-Identifier: MIT
// Shapes with a focus: lens and paraboloid mirror.
#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/scene/meshes/mesh_builder.h"
#include "framework/scene/shapes/shape_checks.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

// How far a spherical face stands above its rim's plane at distance h from the axis, from its
// vertex: R - sqrt(R² - h²) without the difference of near numbers. Negative for a concave face.
double sagitta(double curvatureRadius, double h) {
    if (curvatureRadius == 0.0) return 0.0;
    const double r = std::abs(curvatureRadius);
    return std::copysign(h * h / (r + std::sqrt(std::max(0.0, r * r - h * h))), curvatureRadius);
}

// The profile of the upper face, from the axis to the rim, with its vertex at `vertexY`.
std::vector<ProfilePoint> faceProfile(double curvatureRadius, double vertexY, double rimRadius,
                                      unsigned rings) {
    if (curvatureRadius == 0.0) {
        return {{0.0, vertexY, {0.0, 1.0}}, {rimRadius, vertexY, {0.0, 1.0}}};
    }
    const double rimAngle = std::asin(std::min(1.0, rimRadius / std::abs(curvatureRadius)));
    std::vector<ProfilePoint> profile;
    for (unsigned j = 0; j <= rings; ++j) {
        const double angle = rimAngle * j / rings;
        // The rim is shared with the wall, so it is the rim's radius to the bit.
        const double h = j == rings ? rimRadius : std::abs(curvatureRadius) * std::sin(angle);
        profile.push_back(
            {h,
             vertexY - sagitta(curvatureRadius, h),
             {h / curvatureRadius,
              std::sqrt(std::max(0.0, 1.0 - h * h / (curvatureRadius * curvatureRadius)))}});
    }
    return profile;
}

void checkCurvature(const char* member, double radius, double diameter) {
    if (std::isfinite(radius) && (radius == 0.0 || std::abs(radius) >= 0.5 * diameter)) return;
    throw ConfigError(
        fmt::format("{} must be 0 (flat) or at least half the diameter ({}) in size, not {}.",
                    member, 0.5 * diameter, radius));
}

}  // namespace

Mesh makeLens(const LensShape& shape) {
    requirePositive("diameter", shape.diameter);
    checkCurvature("top_radius", shape.topRadius, shape.diameter);
    checkCurvature("bottom_radius", shape.bottomRadius, shape.diameter);
    requireCells("segments", shape.segments, 3);
    const bool byCenter = shape.centerThickness != 0.0;
    if (byCenter == (shape.edgeThickness != 0.0)) {
        throw ConfigError("Exactly one of center_thickness and edge_thickness must be given.");
    }
    requirePositive(byCenter ? "center_thickness" : "edge_thickness",
                    byCenter ? shape.centerThickness : shape.edgeThickness);
    const double rim = 0.5 * shape.diameter;
    const double sagittas = sagitta(shape.topRadius, rim) + sagitta(shape.bottomRadius, rim);
    const double center = byCenter ? shape.centerThickness : shape.edgeThickness + sagittas;
    const double edge = byCenter ? shape.centerThickness - sagittas : shape.edgeThickness;
    if (!(center > 0.0 && edge > 0.0)) {
        throw ConfigError(fmt::format("{} must be greater than {}, or the two faces cross.",
                                      byCenter ? "center_thickness" : "edge_thickness",
                                      byCenter ? sagittas : -sagittas));
    }
    const unsigned rings = std::max(1u, shape.segments / 4);
    const std::vector<ProfilePoint> top = faceProfile(shape.topRadius, 0.5 * center, rim, rings);
    std::vector<ProfilePoint> bottom = faceProfile(shape.bottomRadius, 0.5 * center, rim, rings);
    for (ProfilePoint& point : bottom) {
        point.y = -point.y;
        point.normal.y = -point.normal.y;
    }
    MeshBuilder builder;
    builder.addRevolved(top, shape.segments);
    builder.addRevolved({{rim, top.back().y, {1.0, 0.0}}, {rim, bottom.back().y, {1.0, 0.0}}},
                        shape.segments);
    builder.addRevolved(bottom, shape.segments);
    return builder.finish("lens");
}

Mesh makeParaboloid(const ParaboloidShape& shape) {
    requirePositive("focal_length", shape.focalLength);
    requirePositive("diameter", shape.diameter);
    requireCells("segments", shape.segments, 3);
    const unsigned rings = std::max(1u, shape.segments / 2);
    std::vector<ProfilePoint> profile;
    for (unsigned j = 0; j <= rings; ++j) {
        const double h = 0.5 * shape.diameter * j / rings;
        // The gradient of y - h²/4f, which points to the side of the focus.
        const glm::dvec2 normal = glm::normalize(glm::dvec2(-h / (2.0 * shape.focalLength), 1.0));
        profile.push_back({h, h * h / (4.0 * shape.focalLength), normal});
    }
    MeshBuilder builder;
    builder.addRevolved(profile, shape.segments);
    return builder.finish("paraboloid");
}

}  // namespace kaustik::scene
