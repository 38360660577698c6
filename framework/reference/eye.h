// SPDX-License-Identifier: MIT
// The pinhole camera of the reference: where a point of the scene falls in the picture, and how
// much of a pixel a piece of surface there covers. The same camera as render/view.h, in local
// coordinates and in double. Pixels are numbered in the order of images: rows from the top.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "framework/reference/embree_scene.h"

namespace kaustik::reference {

struct Projection {
    bool onScreen = false;
    std::uint32_t pixel = 0;  // row * width + column
    double depth = 0.0;       // planar view depth, m
};

class Eye {
  public:
    Eye(const EmbreeScene& scene, int width, int height);

    [[nodiscard]] Projection project(const glm::dvec3& position) const {
        Projection result;
        const glm::dvec3 offset = position - position_;
        result.depth = -glm::dot(offset, backward_);
        if (!(result.depth >= nearMeters_)) return result;
        const double perDepth = 1.0 / result.depth;
        const double x = (glm::dot(offset, right_) * perDepth + tangents_.x) * pixelsPerTangent_;
        const double y = (glm::dot(offset, up_) * perDepth + tangents_.y) * pixelsPerTangent_;
        if (!(x >= 0.0 && y >= 0.0 && x < width_ && y < height_)) return result;
        result.onScreen = true;
        result.pixel = static_cast<std::uint32_t>((height_ - 1 - static_cast<int>(y)) * width_ +
                                                  static_cast<int>(x));
        return result;
    }

    // Continuous pixels from the top left corner, on the screen or next to it; infinite for a point
    // that is not before the eye.
    [[nodiscard]] glm::dvec2 pixelOf(const glm::dvec3& position) const {
        const glm::dvec3 offset = position - position_;
        const double depth = -glm::dot(offset, backward_);
        if (!(depth > 0.0)) return glm::dvec2(std::numeric_limits<double>::infinity());
        return {(glm::dot(offset, right_) / depth + tangents_.x) * pixelsPerTangent_,
                (tangents_.y - glm::dot(offset, up_) / depth) * pixelsPerTangent_};
    }

    // The share of a pixel's area that a square metre of surface covers there, 1/m²: the mean over
    // the pixel of an irradiance is the sum of flux times this.
    [[nodiscard]] double coverage(const glm::dvec3& position, const glm::dvec3& geometricNormal,
                                  double depth) const {
        return std::abs(glm::dot(geometricNormal, position - position_)) / (depth * depth * depth) *
               pixelsPerTangent_ * pixelsPerTangent_;
    }

    // The mean radiance over the pixel per W/sr, for a point that sends out an intensity.
    [[nodiscard]] double coverageOfPoint(const glm::dvec3& position, double depth) const {
        return glm::length(position - position_) / (depth * depth * depth) * pixelsPerTangent_ *
               pixelsPerTangent_;
    }

    // The direction through a point of the picture (continuous pixels from the top left corner).
    // Its length is the distance at a depth of 1 m.
    [[nodiscard]] glm::dvec3 ray(double column, double row) const {
        return (column / pixelsPerTangent_ - tangents_.x) * right_ +
               (tangents_.y - row / pixelsPerTangent_) * up_ - backward_;
    }

    [[nodiscard]] bool seesSide(const glm::dvec3& position, const glm::dvec3& geometricNormal,
                                const glm::dvec3& arriving) const {
        return (glm::dot(geometricNormal, position_ - position) > 0.0) ==
               (glm::dot(geometricNormal, arriving) < 0.0);
    }
    // What is nearer than the near plane hides nothing.
    [[nodiscard]] bool isVisible(const EmbreeScene& scene, const glm::dvec3& position,
                                 const TriangleId& start, double depth) const {
        return scene.isVisible(position, start, position_, nearMeters_ / depth);
    }

    [[nodiscard]] const glm::dvec3& position() const { return position_; }
    [[nodiscard]] double nearMeters() const { return nearMeters_; }
    [[nodiscard]] double footprintPerMeter() const { return 1.0 / pixelsPerTangent_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

  private:
    glm::dvec3 position_{0.0};  // local
    glm::dvec3 right_{0.0};
    glm::dvec3 up_{0.0};
    glm::dvec3 backward_{0.0};
    glm::dvec2 tangents_{1.0};
    double pixelsPerTangent_ = 1.0;  // pixels are square
    double nearMeters_ = 0.01;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace kaustik::reference
