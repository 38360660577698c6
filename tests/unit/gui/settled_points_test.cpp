// SPDX-License-Identifier: MIT
// Settings as points of time and error, and the front of those that no other one beats.
#include "framework/gui/settled_points.h"

#include <gtest/gtest.h>

namespace kaustik::gui::test {
namespace {

using Indices = std::vector<std::size_t>;

TEST(ParetoFront, HasWhatNoOtherOneBeatsInBoth) {
    // Of those with 3 ms the worse is beaten by the better, and (4, 2) by (3, 1).
    EXPECT_EQ(paretoFront({{3, 1}, {1, 9}, {4, 2}, {3, 5}, {9, 0.5}, {1, 9}}), (Indices{1, 0, 4}));
    EXPECT_EQ(paretoFront({}), Indices{});
    EXPECT_EQ(paretoFront({{5, 5}}), Indices{0});
    // All on a falling line are on it, by rising time.
    EXPECT_EQ(paretoFront({{3, 1}, {2, 2}, {1, 3}}), (Indices{2, 1, 0}));
}

// By its definition, of points that nobody chose.
TEST(ParetoFront, IsThatOfItsDefinition) {
    std::vector<TimeAndError> points;
    unsigned state = 1;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 28u);  // so few values that many are equal
    };
    for (int i = 0; i < 60; ++i)
        points.push_back({next(), next()});
    const Indices front = paretoFront(points);
    const auto beats = [](const TimeAndError& a, const TimeAndError& b) {
        return a.milliseconds <= b.milliseconds && a.error <= b.error &&
               (a.milliseconds < b.milliseconds || a.error < b.error);
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool isBeaten = std::any_of(points.begin(), points.end(), [&](const auto& other) {
            return beats(other, points[i]);
        });
        const bool isOnFront = std::any_of(front.begin(), front.end(), [&](std::size_t at) {
            return points[at].milliseconds == points[i].milliseconds &&
                   points[at].error == points[i].error;
        });
        EXPECT_EQ(isOnFront, !isBeaten) << i;
    }
}

class SettledPointTest : public testing::Test {
  protected:
    SettledPointTest() {
        result.order = result.variants[0].order = 7;
        result.variants[0].isSettled = true;
        result.variants[0].frameMs = {90.0, 5.0, 7.0};
        reference.aim = ReferenceAim{result.document.scene, {}, result.document.size, {}, 0};
        reference.photons = 1000;
        reference.judgements[0].order = 7;
        reference.judgements[0].whole = {
            {"caustic_irradiance", {{"rel_mse", 0.25}, {"flip_ldr", nullptr}}}};
    }
    [[nodiscard]] std::optional<SettledPoint> point() const {
        return settledPoint(result, 0, reference, true);
    }
    FrameResult result;
    ReferenceState reference;
};

TEST_F(SettledPointTest, HasTheMedianAndTheErrorsOfItsOwnFrame) {
    const std::optional<SettledPoint> found = point();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->frameMs, 6.0);
    EXPECT_EQ(found->error("rel_mse"), 0.25);
    EXPECT_EQ(found->error("flip_ldr"), std::nullopt);
    EXPECT_EQ(found->error("rmse"), std::nullopt);
    EXPECT_FALSE(settledPoint(result, 1, reference, true)) << "there is no B";
    reference.judgements[0].order = 6;
    EXPECT_FALSE(point()) << "the errors are those of a frame before";
    reference.judgements[0].order = 7;
    result.variants[0].isSettled = false;
    EXPECT_FALSE(point());
    result.variants[0].isSettled = true;
    result.document.edits.timeSeconds = 1.0;
    EXPECT_FALSE(point()) << "the reference is of another moment";
}

TEST_F(SettledPointTest, OfTheSameSettingsTheNewestStays) {
    std::vector<SettledPoint> points;
    addPoint(points, *point());
    result.variants[0].frameMs = {9.0, 9.0};
    addPoint(points, *point());
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points[0].frameMs, 9.0);
    result.document.variant.assignments["emit.photons"] = "8x8";
    addPoint(points, *point());
    EXPECT_EQ(points.size(), 2u);
    EXPECT_TRUE(areComparable(points[0], points[1]));
    reference.photons = 2000;
    EXPECT_FALSE(areComparable(points[0], *point())) << "by another reference";
}

}  // namespace
}  // namespace kaustik::gui::test
