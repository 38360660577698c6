// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "framework/numerics/suite.h"

namespace kaustik::numerics {
namespace {

Row row(Bound bound, double expected, double measured, double tolerance = 0.0) {
    Row result;
    result.expected = expected;
    result.measured = measured;
    result.tolerance = tolerance;
    result.bound = bound;
    return result;
}

TEST(Row, PassesWithinItsToleranceOnBothSides) {
    EXPECT_TRUE(row(Bound::near, 2.0, 2.5, 0.5).passes());
    EXPECT_TRUE(row(Bound::near, 2.0, 1.5, 0.5).passes());
    EXPECT_FALSE(row(Bound::near, 2.0, 2.75, 0.5).passes());
    EXPECT_FALSE(row(Bound::near, 2.0, 1.25, 0.5).passes());
}

TEST(Row, WithABoundOnOneSideIsFreeOnTheOther) {
    EXPECT_TRUE(row(Bound::atLeast, 200.0, 5000.0).passes());
    EXPECT_TRUE(row(Bound::atLeast, 200.0, 200.0).passes());
    EXPECT_FALSE(row(Bound::atLeast, 200.0, 199.0).passes());
    EXPECT_TRUE(row(Bound::atMost, 0.5, -3.0).passes());
    EXPECT_FALSE(row(Bound::atMost, 0.5, 0.75).passes());
    EXPECT_EQ(row(Bound::atLeast, 200.0, 0.0).expectedText(), "at least 200");
    EXPECT_EQ(row(Bound::atMost, 0.5, 0.0).expectedText(), "at most 0.5");
}

TEST(Row, OfWhatIsNoNumberNeverPasses) {
    const double noNumber = std::numeric_limits<double>::quiet_NaN();
    for (const Bound bound : {Bound::near, Bound::atLeast, Bound::atMost})
        EXPECT_FALSE(row(bound, 0.0, noNumber, 1e9).passes());
    const double endless = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(row(Bound::atLeast, 0.0, endless).passes());
    EXPECT_FALSE(row(Bound::atMost, 0.0, -endless).passes());
}

}  // namespace
}  // namespace kaustik::numerics
