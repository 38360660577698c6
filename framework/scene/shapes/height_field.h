// SPDX-License-Identifier: MIT
// Wavy water: a sum of travelling cosine waves over the xz-plane, in metres and seconds,
// y = sum A cos(k·(x, z) - omega t + phase), evaluated in double with exact normals.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

inline constexpr double kGravityMetersPerSecondSquared = 9.80665;

struct HeightSample {
    double height = 0.0;
    glm::dvec3 normal{0.0, 1.0, 0.0};  // unit, upwards
};

// The wave vector (along x and z) in rad/m, and the angular frequency in rad/s: the wave's own, or
// sqrt(g k) for deep water where it is negative.
[[nodiscard]] glm::dvec2 waveVector(const Wave& wave);
[[nodiscard]] double angularFrequency(const Wave& wave);

// The waves of a field at one time, for many points of it.
class WavesAtTime {
  public:
    WavesAtTime(const HeightField& field, double timeSeconds);
    [[nodiscard]] HeightSample sample(const glm::dvec2& xz) const;

  private:
    struct Moved {
        glm::dvec2 vector;    // rad/m
        double turned = 0.0;  // rad, since time 0
        double phaseRadians = 0.0;
        double amplitudeMeters = 0.0;
    };
    std::vector<Moved> waves_;
};

[[nodiscard]] HeightSample evaluateHeightField(const HeightField& field, const glm::dvec2& xz,
                                               double timeSeconds);

// The field as a grid of (cells.x + 1) x (cells.y + 1) vertices, rows along x from the corner with
// the least x and z: vertex j (cells.x + 1) + i lies at ((i, j)/cells - 1/2) size. uv: metres from
// that corner. Throws ConfigError that names the value at fault as scene files spell it.
[[nodiscard]] Mesh makeHeightField(const HeightField& field, double timeSeconds);

// Makes the positions and normals of all height fields those at `timeSeconds`.
void setTime(Scene& scene, double timeSeconds);

}  // namespace kaustik::scene
