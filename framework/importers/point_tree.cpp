// SPDX-License-Identifier: MIT
#include "framework/importers/point_tree.h"

#include <algorithm>
#include <numeric>

namespace kaustik::scene {
namespace {

constexpr std::size_t kLeafPoints = 8;

bool isInside(const std::array<glm::dvec2, 3>& triangle, const glm::dvec2& point) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (point == triangle[i]) return false;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (cross(triangle[i], triangle[(i + 1) % 3], point) < 0.0) return false;
    }
    return true;
}

// Whether a box lies beyond a side of the triangle: its corner that is farthest inwards does.
bool isBeyondASide(const std::array<glm::dvec2, 3>& triangle, const glm::dvec2& low,
                   const glm::dvec2& high) {
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2& a = triangle[i];
        const glm::dvec2& b = triangle[(i + 1) % 3];
        const glm::dvec2 innermost(b.y - a.y < 0.0 ? high.x : low.x,
                                   b.x - a.x > 0.0 ? high.y : low.y);
        if (cross(a, b, innermost) < 0.0) return true;
    }
    return false;
}

}  // namespace

PointTree::PointTree(const std::vector<glm::dvec2>& points)
    : points_(points), order_(points.size()), leafOf_(points.size()), isOn_(points.size(), false) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    nodes_.emplace_back();
    build(0, 0, points.size());
}

void PointTree::build(std::size_t node, std::size_t first, std::size_t count) {
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    glm::dvec2 low = points_[*begin];
    glm::dvec2 high = low;
    for (auto i = begin; i != end; ++i) {
        low = glm::min(low, points_[*i]);
        high = glm::max(high, points_[*i]);
    }
    nodes_[node].low = low;
    nodes_[node].high = high;
    if (count <= kLeafPoints) {
        nodes_[node].first = first;
        nodes_[node].count = count;
        for (auto i = begin; i != end; ++i)
            leafOf_[*i] = node;
        return;
    }
    const glm::length_t axis = high.x - low.x > high.y - low.y ? 0 : 1;
    const std::size_t half = count / 2;
    std::nth_element(
        begin, begin + static_cast<std::ptrdiff_t>(half), end,
        [&](std::size_t a, std::size_t b) { return points_[a][axis] < points_[b][axis]; });
    const std::size_t left = nodes_.size();
    nodes_[node].left = left;
    nodes_.resize(left + 2);
    nodes_[left].parent = node;
    nodes_[left + 1].parent = node;
    build(left, first, half);
    build(left + 1, first + half, count - half);
}

void PointTree::set(std::size_t point, bool isOn) {
    if (isOn_[point] == isOn) return;
    isOn_[point] = isOn;
    for (std::size_t node = leafOf_[point];; node = nodes_[node].parent) {
        ++work_;
        nodes_[node].on += isOn ? 1 : std::size_t(-1);
        if (node == 0) return;
    }
}

bool PointTree::anyInTriangle(const std::array<glm::dvec2, 3>& triangle) {
    const glm::dvec2 low = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
    const glm::dvec2 high = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
    stack_.assign(1, 0);
    while (!stack_.empty()) {
        const Node& node = nodes_[stack_.back()];
        stack_.pop_back();
        ++work_;
        const bool isApart = node.on == 0 || node.low.x > high.x || node.low.y > high.y ||
                             node.high.x < low.x || node.high.y < low.y;
        if (isApart || isBeyondASide(triangle, node.low, node.high)) continue;
        if (node.left != 0) {
            stack_.push_back(node.left);
            stack_.push_back(node.left + 1);
            continue;
        }
        for (std::size_t i = node.first; i < node.first + node.count; ++i) {
            ++work_;
            if (isOn_[order_[i]] && isInside(triangle, points_[order_[i]])) return true;
        }
    }
    return false;
}

}  // namespace kaustik::scene
