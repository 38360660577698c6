// SPDX-License-Identifier: MIT
#include "framework/scene/shapes/height_field.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "framework/scene/meshes/mesh_builder.h"
#include "framework/scene/shapes/shape_checks.h"

namespace kaustik::scene {
namespace {

SurfacePoint gridPoint(const HeightField& field, unsigned i, unsigned j, double timeSeconds) {
    const glm::dvec2 size(field.sizeMeters);
    const glm::dvec2 fromCorner = glm::dvec2(i, j) / glm::dvec2(field.cells) * size;
    const glm::dvec2 xz = fromCorner - 0.5 * size;
    const HeightSample sample = evaluateHeightField(field, xz, timeSeconds);
    return {{xz.x, sample.height, xz.y}, sample.normal, fromCorner};
}

}  // namespace

glm::dvec2 waveVector(const Wave& wave) {
    const double angle = glm::radians(double(wave.directionDegrees));
    const double k = glm::two_pi<double>() / double(wave.wavelengthMeters);
    return k * glm::dvec2(std::cos(angle), std::sin(angle));
}

double angularFrequency(const Wave& wave) {
    if (wave.omegaRadiansPerSecond >= 0.0f) return double(wave.omegaRadiansPerSecond);
    return std::sqrt(kGravityMetersPerSecondSquared * glm::length(waveVector(wave)));
}

HeightSample evaluateHeightField(const HeightField& field, const glm::dvec2& xz,
                                 double timeSeconds) {
    double height = 0.0;
    glm::dvec2 slope(0.0);
    for (const Wave& wave : field.waves) {
        const glm::dvec2 k = waveVector(wave);
        const double phase =
            glm::dot(k, xz) - angularFrequency(wave) * timeSeconds + double(wave.phaseRadians);
        height += double(wave.amplitudeMeters) * std::cos(phase);
        slope -= double(wave.amplitudeMeters) * std::sin(phase) * k;
    }
    return {height, glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y))};
}

Mesh makeHeightField(const HeightField& field, double timeSeconds) {
    requirePositive("size", double(field.sizeMeters.x));
    requirePositive("size", double(field.sizeMeters.y));
    requireCells("cells", field.cells.x, 1);
    requireCells("cells", field.cells.y, 1);
    for (const Wave& wave : field.waves) {
        requirePositive("wavelength", double(wave.wavelengthMeters));
    }
    MeshBuilder builder;
    builder.addGrid(field.cells.x, field.cells.y,
                    [&](unsigned i, unsigned j) { return gridPoint(field, i, j, timeSeconds); });
    Mesh mesh = builder.finishSheet("water");
    mesh.heightField = field;
    return mesh;
}

void setTime(Scene& scene, double timeSeconds) {
    scene.timeSeconds = timeSeconds;
    for (Mesh& mesh : scene.meshes) {
        if (!mesh.heightField) continue;
        const HeightField& field = *mesh.heightField;
        std::size_t vertex = 0;
        for (unsigned j = 0; j <= field.cells.y; ++j) {
            for (unsigned i = 0; i <= field.cells.x; ++i, ++vertex) {
                const SurfacePoint point = gridPoint(field, i, j, timeSeconds);
                mesh.positions[vertex] = glm::vec3(point.position);
                mesh.normals[vertex] = glm::vec3(point.normal);
            }
        }
    }
}

}  // namespace kaustik::scene
