// SPDX-License-Identifier: MIT
#include "framework/scene/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace kaustik::scene {
namespace {

constexpr int kWidth = 1024;  // as fine as the device keeps images
constexpr int kHeight = 512;

double smooth(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Sums of waves over the sphere, so that there is neither a seam nor a pole.
double clouds(const glm::dvec3& d) {
    double sum = 0.0;
    double weight = 1.0;
    glm::dvec3 p = 2.3 * d;
    for (int octave = 0; octave < 5; ++octave) {
        sum += weight * std::sin(2.1 * p.x + 1.3 * std::sin(1.7 * p.y + 0.4)) *
               std::sin(1.9 * p.z + 1.1 * std::sin(1.5 * p.x + 2.0)) *
               std::cos(1.6 * p.y + 0.8 * std::sin(1.3 * p.z));
        weight *= 0.55;
        p = 1.9 * glm::dvec3(0.8 * p.x + 0.6 * p.z, p.y + 0.7, 0.8 * p.z - 0.6 * p.x);
    }
    return sum;
}

glm::dvec3 sky(const glm::dvec3& d) {
    if (d.y < 0.0) {
        // The ground as a plane: paths across fields, which the distance swallows.
        const double x = 1.6 * d.x / -d.y;
        const double z = 1.6 * d.z / -d.y;
        const bool isDark = (std::floor(x) + std::floor(z)) * 0.5 !=
                            std::floor((std::floor(x) + std::floor(z)) * 0.5);
        const glm::dvec3 field =
            isDark ? glm::dvec3(0.10, 0.13, 0.06) : glm::dvec3(0.34, 0.30, 0.20);
        return glm::mix(glm::dvec3(0.45, 0.42, 0.38), field, smooth(0.02, 0.25, -d.y));
    }
    const glm::dvec3 clear =
        glm::mix(glm::dvec3(1.35, 1.25, 1.1), glm::dvec3(0.28, 0.5, 1.0), smooth(0.0, 0.55, d.y));
    return glm::mix(clear, glm::dvec3(1.7), 0.85 * smooth(0.1, 0.7, clouds(d)));
}

glm::dvec3 grid(double longitude, double latitude) {
    const auto index = [](double radians) {
        return static_cast<int>(std::floor(glm::degrees(radians) / 10.0 + 1e-9));
    };
    const bool isDark = ((index(longitude) + index(latitude)) & 1) != 0;
    const double c = std::cos(longitude);
    const double s = std::sin(longitude);
    const glm::dvec3 color(0.6 + 0.4 * c, 0.6 + 0.4 * s, latitude >= 0.0 ? 1.0 : 0.35);
    return (isDark ? 0.15 : 1.0) * color;
}

}  // namespace

glm::dvec2 environmentPosition(const Scene& scene, const glm::dvec3& direction) {
    const bool isVertical = direction.x == 0.0 && direction.z == 0.0;
    const double longitude = isVertical ? 0.0 : std::atan2(direction.x, -direction.z);
    const double turned =
        0.5 + longitude / glm::two_pi<double>() + scene.environmentTurnDegrees / 360.0;
    return {turned - std::floor(turned),
            0.5 + std::asin(std::clamp(direction.y, -1.0, 1.0)) / glm::pi<double>()};
}

Image makeEnvironment(EnvironmentPattern pattern) {
    Image image(kWidth, kHeight, 3);
    for (int row = 0; row < kHeight; ++row) {
        const double latitude = (0.5 - (row + 0.5) / kHeight) * glm::pi<double>();
        for (int column = 0; column < kWidth; ++column) {
            const double longitude = ((column + 0.5) / kWidth - 0.5) * glm::two_pi<double>();
            const glm::dvec3 direction(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                                       -std::cos(latitude) * std::cos(longitude));
            const glm::dvec3 color =
                pattern == EnvironmentPattern::sky ? sky(direction) : grid(longitude, latitude);
            for (int c = 0; c < 3; ++c)
                image.at(column, row, c) = static_cast<float>(color[c]);
        }
    }
    return image;
}

}  // namespace kaustik::scene
