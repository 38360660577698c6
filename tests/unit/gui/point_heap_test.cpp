// SPDX-License-Identifier: MIT
#include "framework/gui/point_heap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kaustik::gui {
namespace {

using ::testing::ElementsAre;

// Two at one place, one a pixel away, one far from them.
const std::vector<PointOnChart> kPoints = {
    {10.0f, 10.0f}, {90.0f, 10.0f}, {10.0f, 10.0f}, {11.0f, 10.0f}};

TEST(PointHeap, IsWhatLiesWithinReach) {
    EXPECT_THAT(heapAt(kPoints, 10.0f, 12.0f, 4.0f).points, ElementsAre(0, 2, 3));
    EXPECT_THAT(heapAt(kPoints, 89.0f, 10.0f, 4.0f).points, ElementsAre(1));
    EXPECT_TRUE(heapAt(kPoints, 50.0f, 50.0f, 4.0f).points.empty());
    EXPECT_TRUE(heapAt({}, 0.0f, 0.0f, 4.0f).points.empty());
}

TEST(PointHeap, HasTheNearestAsTheNext) {
    EXPECT_EQ(heapAt(kPoints, 12.0f, 10.0f, 4.0f).next, 2u);
    EXPECT_EQ(heapAt(kPoints, 9.0f, 10.0f, 4.0f).next, 0u);
}

TEST(PointHeap, IsGoneThroughByClicks) {
    std::vector<PointOnChart> points = kPoints;
    points[1].isNow = true;  // elsewhere: it does not matter
    std::vector<std::size_t> taken;
    for (int click = 0; click < 6; ++click) {
        const PointHeap heap = heapAt(points, 10.0f, 10.0f, 4.0f);
        taken.push_back(heap.points.at(heap.next));
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i].isNow = i == taken.back();
    }
    EXPECT_THAT(taken, ElementsAre(0, 2, 3, 0, 2, 3));
}

// What is at hand alone under the mouse is what a click takes again.
TEST(PointHeap, OfOneIsThatOne) {
    std::vector<PointOnChart> points = kPoints;
    points[1].isNow = true;
    EXPECT_EQ(heapAt(points, 90.0f, 10.0f, 4.0f).next, 0u);
}

}  // namespace
}  // namespace kaustik::gui
