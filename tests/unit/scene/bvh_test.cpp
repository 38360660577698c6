// SPDX-License-Identifier: MIT
// The bounding volume hierarchy: everything is in one leaf, and in the bounds of all nodes above
// it.
#include "framework/scene/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace kaustik::scene {
namespace {

using transport::BvhNode;

// Walks down from a node, and checks what it finds there against what was given.
class Walk {
  public:
    Walk(const Bvh& bvh, const std::vector<BoxBounds>& given)
        : bvh_(bvh), given_(given), seen_(given.size(), 0) {
        visit(0, {}, 0);
    }
    [[nodiscard]] const std::vector<int>& seen() const { return seen_; }
    [[nodiscard]] std::size_t deepest() const { return deepest_; }

  private:
    void visit(std::uint32_t number, std::vector<BoxBounds> above, std::size_t depth) {
        deepest_ = std::max(deepest_, depth);
        const BvhNode& node = bvh_.nodes[number];
        for (std::uint32_t i = 0; i < transport::kBvhWidth; ++i) {
            const std::uint32_t child = node.children[static_cast<glm::length_t>(i)];
            if (child == transport::kBvhNone) continue;
            std::vector<BoxBounds> around = above;
            around.push_back({transport::bvhCorner(node.origin, node.exponents, node.lower, i),
                              transport::bvhCorner(node.origin, node.exponents, node.upper, i)});
            if ((child & transport::kBvhLeaf) == 0) {
                visit(child, around, depth + 1);
                continue;
            }
            const std::uint32_t first = transport::bvhLeafFirst(child);
            for (std::uint32_t j = first; j < first + transport::bvhLeafCount(child); ++j)
                expectWithin(bvh_.order[j], around);
        }
    }
    void expectWithin(std::uint32_t thing, const std::vector<BoxBounds>& around) {
        ++seen_[thing];
        for (const BoxBounds& box : around) {
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                EXPECT_LE(box.lower[axis], given_[thing].lower[axis]);
                EXPECT_GE(box.upper[axis], given_[thing].upper[axis]);
            }
        }
    }

    const Bvh& bvh_;
    const std::vector<BoxBounds>& given_;
    std::vector<int> seen_;
    std::size_t deepest_ = 0;
};

void expectHoldsAll(const std::vector<BoxBounds>& given) {
    const Bvh bvh = buildBvh(given);
    const Walk walk(bvh, given);
    EXPECT_TRUE(std::all_of(walk.seen().begin(), walk.seen().end(), [](int n) { return n == 1; }));
    EXPECT_EQ(walk.deepest() + 1, bvh.levels.size());
    std::size_t next = 0;
    for (const Bvh::Level& level : bvh.levels) {
        EXPECT_EQ(level.first, next);
        next += level.count;
    }
    EXPECT_EQ(next, bvh.nodes.size());
}

std::vector<BoxBounds> randomBoxes(std::size_t count, float place, float size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> in(-1.0f, 1.0f);
    std::vector<BoxBounds> boxes(count);
    for (BoxBounds& box : boxes) {
        const glm::vec3 middle = place * glm::vec3(in(random), in(random), in(random));
        for (int i = 0; i < 3; ++i)
            box.include(middle + size * glm::vec3(in(random), in(random), in(random)));
    }
    return boxes;
}

TEST(Bvh, HoldsEverythingOnceAndWithinAllNodesAboveIt) {
    expectHoldsAll(randomBoxes(5000, 3.0f, 0.05f));
}

TEST(Bvh, HoldsSmallThingsFarFromItsOrigin) {
    std::vector<BoxBounds> boxes = randomBoxes(500, 1e-3f, 1e-6f);
    for (BoxBounds& box : boxes) {
        box.lower += glm::vec3(1000.0f, -300.0f, 0.1f);
        box.upper += glm::vec3(1000.0f, -300.0f, 0.1f);
    }
    expectHoldsAll(boxes);
}

TEST(Bvh, HoldsFlatThings) {
    std::vector<BoxBounds> boxes = randomBoxes(200, 2.0f, 0.1f);
    for (BoxBounds& box : boxes)
        box.lower.y = box.upper.y = 0.7f;
    expectHoldsAll(boxes);
}

// No cut tells them apart.
TEST(Bvh, HoldsThingsThatAllLieInOnePlace) {
    const std::vector<BoxBounds> boxes(3000, {glm::vec3(0.1f), glm::vec3(0.2f)});
    expectHoldsAll(boxes);
    EXPECT_LE(buildBvh(boxes).levels.size(), 12u);
}

// Each twice as far away as the one before: a cut takes off one of them.
TEST(Bvh, IsNoDeeperThanAListOfHalves) {
    std::vector<BoxBounds> boxes;
    float place = 1e-30f;
    for (int i = 0; i < 200; ++i, place *= 2.0f)
        boxes.push_back({glm::vec3(place), glm::vec3(1.1f * place)});
    expectHoldsAll(boxes);
    EXPECT_LE(buildBvh(boxes).stackSize(), 160u);
}

TEST(Bvh, OfNothingHasARootWithoutChildren) {
    const Bvh bvh = buildBvh({});
    ASSERT_EQ(bvh.nodes.size(), 1u);
    EXPECT_EQ(bvh.nodes.front().children, glm::uvec4(transport::kBvhNone));
    EXPECT_EQ(bvh.levels.size(), 1u);
}

TEST(Bvh, OfOneThingHasItInTheRoot) {
    expectHoldsAll({{glm::vec3(-1.0f), glm::vec3(2.0f)}});
}

}  // namespace
}  // namespace kaustik::scene
