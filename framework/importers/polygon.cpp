// SPDX-License-Identifier: MIT
#include "framework/importers/polygon.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "framework/importers/point_tree.h"

namespace kaustik::scene {
namespace {

// Newell's normal: the sum of the polygon's areas as seen along the axes, twice.
glm::dvec3 areaNormal(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        // Relative to the first corner, or a small polygon far from the origin loses its digits.
        const glm::dvec3 a = corners[i] - corners[0];
        const glm::dvec3 b = corners[(i + 1) % corners.size()] - corners[0];
        sum += glm::cross(a, b);
    }
    return sum;
}

// Along the axis that the normal is nearest to, so that no coordinate is rounded;
// counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners) {
    const glm::dvec3 normal = areaNormal(corners);
    const glm::dvec3 size = glm::abs(normal);
    glm::length_t axis = size.x > size.y ? 0 : 1;
    if (size.z > size[axis]) axis = 2;
    const glm::length_t u = normal[axis] < 0.0 ? (axis + 2) % 3 : (axis + 1) % 3;
    const glm::length_t v = normal[axis] < 0.0 ? (axis + 1) % 3 : (axis + 2) % 3;
    std::vector<glm::dvec2> points;
    points.reserve(corners.size());
    for (const glm::dvec3& corner : corners)
        points.emplace_back(corner[u], corner[v]);
    return points;
}

class Cutter {
  public:
    explicit Cutter(std::vector<glm::dvec2> points)
        : points_(std::move(points)), tree_(points_), count_(points_.size()) {
        const std::size_t n = points_.size();
        before_.resize(n);
        after_.resize(n);
        cutInRound_.assign(n, 0);
        for (std::size_t i = 0; i < n; ++i) {
            before_[i] = (i + n - 1) % n;
            after_[i] = (i + 1) % n;
        }
        for (std::size_t i = 0; i < n; ++i)
            tree_.set(i, turn(i) <= 0.0);
        result_.triangles.reserve(n - 2);
    }

    CutPolygon run() {
        std::vector<std::size_t> candidates(points_.size());
        std::iota(candidates.begin(), candidates.end(), std::size_t{0});
        std::size_t anyCorner = 0;  // to search from
        while (count_ > 3) {
            if (candidates.empty()) {
                // No corner is an ear, as where the polygon crosses itself.
                while (isCut_[anyCorner])
                    anyCorner = after_[anyCorner];
                anyCorner = bestCut(anyCorner);
                result_.isSimple = result_.isSimple && turn(anyCorner) == 0.0;
                cut(anyCorner);
                candidates = {before_[anyCorner], after_[anyCorner]};
                anyCorner = after_[anyCorner];
                continue;
            }
            candidates = cutEars(candidates);
        }
        const auto last = static_cast<std::size_t>(std::find(isCut_.begin(), isCut_.end(), false) -
                                                   isCut_.begin());
        addTriangle(last);
        result_.isSimple = result_.isSimple && turn(last) >= 0.0;
        result_.work += tree_.work() + searched_;
        return std::move(result_);
    }

  private:
    // Cuts off those of the candidates that are ears, no two neighbours, since a fan of them would
    // be slivers. Gives whom to look at next.
    std::vector<std::size_t> cutEars(const std::vector<std::size_t>& candidates) {
        ++round_;
        std::vector<std::size_t> next;
        for (const std::size_t i : candidates) {
            if (count_ == 3) break;
            ++result_.work;
            // A neighbour of one that was cut in this round is among the next already.
            if (isCut_[i] || cutInRound_[i] == round_ || !isEar(i)) continue;
            cut(i);
            for (const std::size_t neighbour : {before_[i], after_[i]}) {
                if (cutInRound_[neighbour] != round_) next.push_back(neighbour);
                cutInRound_[neighbour] = round_;
            }
        }
        return next;
    }

    // Twice the signed area of a corner's triangle: above 0 where it bends outwards.
    [[nodiscard]] double turn(std::size_t i) const {
        return cross(points_[before_[i]], points_[i], points_[after_[i]]);
    }
    [[nodiscard]] bool isEar(std::size_t i) {
        return turn(i) > 0.0 &&
               !tree_.anyInTriangle({points_[before_[i]], points_[i], points_[after_[i]]});
    }

    // The first corner from `start` on that bends outwards or not at all. When much was searched
    // for such corners already, `start` itself: nothing good can be made of that polygon.
    [[nodiscard]] std::size_t bestCut(std::size_t start) {
        std::size_t i = start;
        while (searched_ < 8 * points_.size() && turn(i) < 0.0) {
            ++searched_;
            i = after_[i];
        }
        return i;
    }

    void addTriangle(std::size_t i) { result_.triangles.emplace_back(before_[i], i, after_[i]); }

    void cut(std::size_t i) {
        addTriangle(i);
        isCut_[i] = true;
        --count_;
        tree_.set(i, false);
        after_[before_[i]] = after_[i];
        before_[after_[i]] = before_[i];
        for (const std::size_t neighbour : {before_[i], after_[i]})
            tree_.set(neighbour, turn(neighbour) <= 0.0);
    }

    std::vector<glm::dvec2> points_;
    PointTree tree_;  // of the corners that do not bend outwards
    std::size_t count_;
    std::vector<std::size_t> before_;
    std::vector<std::size_t> after_;
    std::vector<bool> isCut_ = std::vector<bool>(points_.size(), false);
    std::vector<std::size_t> cutInRound_;  // a neighbour of the corner was cut in that round
    std::size_t round_ = 0;
    std::size_t searched_ = 0;
    CutPolygon result_;
};

// Where nothing can be said of the corners.
CutPolygon fan(std::size_t count) {
    CutPolygon result;
    for (std::size_t i = 1; i + 1 < count; ++i)
        result.triangles.emplace_back(0, i, i + 1);
    result.isSimple = false;
    result.work = count;
    return result;
}

// A quadrangle is cut at the corner that bends inwards, if there is one.
CutPolygon cutQuadrangle(std::span<const glm::dvec3> corners) {
    const std::vector<glm::dvec2> p = flattened(corners);
    glm::uint first = 0;
    for (glm::uint i = 0; i < 4; ++i) {
        if (cross(p[(i + 3) % 4], p[i], p[(i + 1) % 4]) < 0.0) first = i;
    }
    CutPolygon result;
    result.triangles = {{first, (first + 1) % 4, (first + 2) % 4},
                        {first, (first + 2) % 4, (first + 3) % 4}};
    for (const glm::uvec3& t : result.triangles)
        result.isSimple = result.isSimple && cross(p[t.x], p[t.y], p[t.z]) >= 0.0;
    result.work = 4;
    return result;
}

}  // namespace

CutPolygon cutPolygon(std::span<const glm::dvec3> corners) {
    assert(corners.size() >= 3);
    if (corners.size() == 3) return {{{0, 1, 2}}, true, 1};
    const bool isFinite = std::all_of(corners.begin(), corners.end(), [](const glm::dvec3& c) {
        return std::isfinite(c.x + c.y + c.z);
    });
    if (!isFinite) return fan(corners.size());
    if (corners.size() == 4) return cutQuadrangle(corners);
    return Cutter(flattened(corners)).run();
}

}  // namespace kaustik::scene
