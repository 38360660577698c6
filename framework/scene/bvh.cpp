// SPDX-License-Identifier: MIT
#include "framework/scene/bvh.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace kaustik::scene {
namespace {

constexpr std::size_t kBins = 16;
// What a step to a node costs, in tests of a triangle.
constexpr float kNodeCost = 1.0f;
// From this depth on parts are halves, so that no list of triangles makes a tree too deep.
constexpr std::size_t kHalvesFrom = 40;

struct BinaryNode {
    BoxBounds bounds;
    std::uint32_t first = 0;  // a leaf: of Bvh::order; else its children's numbers, which are
    std::uint32_t count = 0;  // `first` and `first + 1`; 0: not a leaf
};

float areaOf(const BoxBounds& box) {
    const glm::vec3 size = glm::max(box.upper - box.lower, glm::vec3(0.0f));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

class Builder {
  public:
    explicit Builder(std::span<const BoxBounds> bounds) : bounds_(bounds), order_(bounds.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        middles_.reserve(bounds.size());
        for (const BoxBounds& box : bounds)
            middles_.push_back(0.5f * box.lower + 0.5f * box.upper);
        if (!bounds.empty()) build();
    }
    [[nodiscard]] const std::vector<BinaryNode>& nodes() const { return nodes_; }
    [[nodiscard]] std::vector<std::uint32_t> releaseOrder() { return std::move(order_); }

  private:
    struct Part {
        std::uint32_t node;
        std::uint32_t first;
        std::uint32_t count;
        std::size_t depth;
    };
    void build() {
        nodes_.emplace_back();
        std::vector<Part> waiting{{0, 0, static_cast<std::uint32_t>(order_.size()), 0}};
        while (!waiting.empty()) {
            const Part part = waiting.back();
            waiting.pop_back();
            const std::uint32_t cut = split(part);
            if (cut == 0) {
                nodes_[part.node].first = part.first;
                nodes_[part.node].count = part.count;
                continue;
            }
            const auto child = static_cast<std::uint32_t>(nodes_.size());
            nodes_[part.node].first = child;
            nodes_.resize(nodes_.size() + 2);
            waiting.push_back({child + 1, part.first + cut, part.count - cut, part.depth + 1});
            waiting.push_back({child, part.first, cut, part.depth + 1});
        }
    }

    // How many go to the first child, ordered so that they come first; 0: it stays a leaf.
    std::uint32_t split(const Part& part) {
        BoxBounds box;
        BoxBounds middles;
        for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
            box.include(bounds_[order_[i]]);
            middles.include(middles_[order_[i]]);
        }
        nodes_[part.node].bounds = box;
        if (part.count == 1) return 0;
        const Cut cut = part.depth < kHalvesFrom ? bestCut(part, middles) : Cut{};
        const bool isSmall = part.count <= transport::kBvhLeafMost;
        const float area = areaOf(box);
        const float asLeaf = area * static_cast<float>(part.count);
        if (cut.axis < 0 || (isSmall && cut.cost + kNodeCost * area >= asLeaf)) {
            return isSmall ? 0 : halve(part, middles);
        }
        const auto begin = order_.begin() + part.first;
        const auto isFirst = [&](std::uint32_t i) {
            return binOf(middles_[i], middles, cut.axis) <= cut.bin;
        };
        return static_cast<std::uint32_t>(std::partition(begin, begin + part.count, isFirst) -
                                          begin);
    }

    // Where all lie in one place, or the tree is deep.
    std::uint32_t halve(const Part& part, const BoxBounds& middles) {
        const glm::vec3 size = middles.upper - middles.lower;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto begin = order_.begin() + part.first;
        const std::uint32_t half = part.count / 2;
        std::nth_element(begin, begin + half, begin + part.count,
                         [&](std::uint32_t a, std::uint32_t b) {
                             return middles_[a][axis] < middles_[b][axis];
                         });
        return half;
    }

    struct Cut {
        int axis = -1;
        std::size_t bin = 0;  // the last of the first child
        float cost = 0.0f;
    };
    static std::size_t binOf(const glm::vec3& middle, const BoxBounds& middles, int axis) {
        const float size = middles.upper[axis] - middles.lower[axis];
        const float place = (middle[axis] - middles.lower[axis]) / size;
        const float bin = place * static_cast<float>(kBins);
        return bin > 0.0f ? std::min(static_cast<std::size_t>(bin), kBins - 1) : 0;
    }
    [[nodiscard]] Cut bestCut(const Part& part, const BoxBounds& middles) const {
        struct Bin {
            BoxBounds box;
            std::uint32_t count = 0;
        };
        Cut best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(middles.upper[axis] > middles.lower[axis])) continue;
            std::array<Bin, kBins> bins;
            for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
                Bin& bin = bins[binOf(middles_[order_[i]], middles, axis)];
                bin.box.include(bounds_[order_[i]]);
                ++bin.count;
            }
            std::array<float, kBins> after{};  // the cost of all bins from here on
            Bin sum;
            for (std::size_t i = kBins; i-- > 1;) {
                sum.box.include(bins[i].box);
                sum.count += bins[i].count;
                after[i] = areaOf(sum.box) * static_cast<float>(sum.count);
            }
            sum = {};
            for (std::size_t i = 0; i + 1 < kBins; ++i) {
                sum.box.include(bins[i].box);
                sum.count += bins[i].count;
                if (sum.count == 0 || sum.count == part.count) continue;
                const float cost = areaOf(sum.box) * static_cast<float>(sum.count) + after[i + 1];
                if (best.axis < 0 || cost < best.cost) best = {axis, i, cost};
            }
        }
        return best;
    }

    std::span<const BoxBounds> bounds_;
    std::vector<glm::vec3> middles_;
    std::vector<std::uint32_t> order_;
    std::vector<BinaryNode> nodes_;
};

// Of a binary node up to four that stand for it: the largest are opened first.
std::vector<std::uint32_t> opened(const std::vector<BinaryNode>& binary, std::uint32_t node) {
    std::vector<std::uint32_t> parts{node};
    if (binary[node].count > 0) return parts;
    while (parts.size() < transport::kBvhWidth) {
        std::size_t largest = parts.size();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (binary[parts[i]].count > 0) continue;
            if (largest == parts.size() ||
                areaOf(binary[parts[i]].bounds) > areaOf(binary[parts[largest]].bounds)) {
                largest = i;
            }
        }
        if (largest == parts.size()) break;
        const std::uint32_t child = binary[parts[largest]].first;
        parts[largest] = child;
        parts.push_back(child + 1);
    }
    return parts;
}

std::uint32_t leafOf(const BinaryNode& node) {
    return transport::kBvhLeaf | (node.count - 1) << transport::kBvhLeafShift | node.first;
}

}  // namespace

Bvh buildBvh(std::span<const BoxBounds> bounds) {
    Bvh bvh;
    Builder builder(bounds);
    const std::vector<BinaryNode>& binary = builder.nodes();
    std::vector<std::uint32_t> level;
    if (!binary.empty()) level.push_back(0);
    if (binary.empty()) {
        const std::array<glm::vec3, 4> none{};
        bvh.nodes.push_back(
            transport::bvhNodeOf(glm::uvec4(transport::kBvhNone), none.data(), none.data()));
        bvh.nodes.front().origin = glm::vec3(0.0f);
        bvh.levels.push_back({0, 1});
    }
    while (!level.empty()) {
        bvh.levels.push_back({bvh.nodes.size(), level.size()});
        const std::size_t nextFirst = bvh.nodes.size() + level.size();
        std::vector<std::uint32_t> next;
        for (const std::uint32_t node : level) {
            glm::uvec4 children(transport::kBvhNone);
            std::array<glm::vec3, 4> lower{};
            std::array<glm::vec3, 4> upper{};
            glm::length_t i = 0;
            for (const std::uint32_t part : opened(binary, node)) {
                const BinaryNode& child = binary[part];
                if (child.count > 0) {
                    children[i] = leafOf(child);
                } else {
                    children[i] = static_cast<std::uint32_t>(nextFirst + next.size());
                    next.push_back(part);
                }
                lower[static_cast<std::size_t>(i)] = child.bounds.lower;
                upper[static_cast<std::size_t>(i)] = child.bounds.upper;
                ++i;
            }
            bvh.nodes.push_back(transport::bvhNodeOf(children, lower.data(), upper.data()));
        }
        level = std::move(next);
    }
    bvh.order = builder.releaseOrder();
    return bvh;
}

}  // namespace kaustik::scene
