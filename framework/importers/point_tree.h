// SPDX-License-Identifier: MIT
// Points of a plane that can be switched on and off, and the question whether any that is on lies
// in a triangle: a k-d tree whose nodes count what is on below them.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace kaustik::scene {

// Twice the area of a triangle, positive where it turns counter-clockwise.
[[nodiscard]] inline double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class PointTree {
  public:
    // All points are off. `points` must outlive this.
    explicit PointTree(const std::vector<glm::dvec2>& points);

    void set(std::size_t point, bool isOn);
    // Whether a point that is on lies in the triangle (counter-clockwise) or on its rim, but at
    // none of its corners.
    [[nodiscard]] bool anyInTriangle(const std::array<glm::dvec2, 3>& triangle);
    // How many nodes and points were looked at so far.
    [[nodiscard]] std::size_t work() const { return work_; }

  private:
    struct Node {
        glm::dvec2 low{0.0};
        glm::dvec2 high{0.0};
        std::size_t first = 0;  // of order_, when it is a leaf
        std::size_t count = 0;
        std::size_t parent = 0;
        std::size_t left = 0;  // the right one is the next; 0: a leaf
        std::size_t on = 0;
    };
    void build(std::size_t node, std::size_t first, std::size_t count);

    const std::vector<glm::dvec2>& points_;
    std::vector<std::size_t> order_;
    std::vector<std::size_t> leafOf_;
    std::vector<bool> isOn_;
    std::vector<Node> nodes_;
    std::vector<std::size_t> stack_;
    std::size_t work_ = 0;
};

}  // namespace kaustik::scene
