// SPDX-License-Identifier: MIT
// What each pixel sees of which facets of receivers, as convex polygons on the screen. The eye is
// that of the reference (reference/eye.h): a pinhole to whose straight rays dielectrics are
// invisible, behind a near plane. Pixels: x from the left, y from the top, numbered by rows.
//
// Where a facet covers a whole pixel there is nothing to cut; elsewhere what is surely seen and
// what may be seen of it differ by a hair (kHair), which holds the rounding of all corners.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/certify/geometry.h"
#include "framework/certify/polygon.h"

namespace kaustik::certify {

// A part of a pixel: a convex polygon from the pixel's lower left... corners in pixels of the
// screen.
struct SeenPart {
    std::uint32_t facet = 0;
    bool isWhole = false;          // all of the pixel
    bool isSure = false;           // counts below, else above
    std::vector<HalfPlane> edges;  // in pixels; where not whole
};

class EyeView {
  public:
    EyeView(const Geometry& geometry, int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] const std::vector<SeenPart>& parts(std::size_t pixel) const {
        return pixels_[pixel];
    }
    // The pixels that may see the facet: first and last column and row; empty where last < first.
    struct Extent {
        int left = 0;
        int right = -1;
        int top = 0;
        int bottom = -1;
    };
    [[nodiscard]] const Extent& extent(std::uint32_t facet) const { return extents_[facet]; }
    // No square metre of what the pixel sees covers more of it, 1/m²: what a watt at an unknown
    // place brings at most.
    [[nodiscard]] double maxCoverage(std::size_t pixel) const { return coverage_[pixel]; }

    [[nodiscard]] const glm::dvec3& position() const { return position_; }
    [[nodiscard]] const glm::dvec3& right() const { return right_; }
    [[nodiscard]] const glm::dvec3& up() const { return up_; }
    [[nodiscard]] const glm::dvec3& backward() const { return backward_; }
    [[nodiscard]] const glm::dvec2& tangents() const { return tangents_; }
    [[nodiscard]] double pixelsPerTangent() const { return pixelsPerTangent_; }
    [[nodiscard]] double nearMeters() const { return nearMeters_; }

  private:
    // Of a polygon in space what is beyond the near plane, on the screen.
    [[nodiscard]] std::vector<Point> project(const std::vector<glm::dvec3>& corners) const;
    void seePixel(const Geometry& geometry, std::size_t pixel,
                  const std::vector<std::uint32_t>& facets,
                  const std::vector<std::vector<Point>>& outlines);

    int width_;
    int height_;
    glm::dvec3 position_{0.0};
    glm::dvec3 right_{0.0};
    glm::dvec3 up_{0.0};
    glm::dvec3 backward_{0.0};
    glm::dvec2 tangents_{1.0};
    double pixelsPerTangent_ = 1.0;
    double nearMeters_ = 0.01;
    std::vector<std::vector<SeenPart>> pixels_;
    std::vector<Extent> extents_;
    std::vector<double> coverage_;
};

// The share of the pixel at column u and row v that a square metre of the facet's plane covers,
// 1/m², from its least to its largest value there. `height`: of the eye above the plane, m.
[[nodiscard]] Interval coverageIn(const EyeView& eye, const Facet& facet, const Interval& height,
                                  int u, int v);

// The half-planes that hold a convex polygon, known up to the rounding of its corners: outer ones
// hold all of it, and inner ones nothing else, within `reach` of it.
[[nodiscard]] Region regionOf(const std::vector<Point>& corners, double hair);

}  // namespace kaustik::certify
