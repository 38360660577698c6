// SPDX-License-Identifier: MIT
#include "framework/judge/significance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kaustik::judge {
namespace {

// Values of the usual tables, to their last digit.
TEST(Significance, HasTheCriticalValuesOfTables) {
    EXPECT_NEAR(criticalZ(0.05), 1.95996, 5e-6);
    EXPECT_NEAR(criticalZ(0.01), 2.57583, 5e-6);
    EXPECT_NEAR(criticalChiSquared(0.05, 1), 3.841, 5e-4);
    EXPECT_NEAR(criticalChiSquared(0.01, 2), 9.210, 5e-4);
    EXPECT_NEAR(criticalChiSquared(0.05, 3), 7.815, 5e-4);
    EXPECT_NEAR(criticalChiSquared(0.01, 4), 13.277, 5e-4);
    EXPECT_NEAR(criticalChiSquared(0.001, 7), 24.322, 5e-4);
    EXPECT_NEAR(criticalChiSquared(0.05, 10), 18.307, 5e-4);
}

TEST(Significance, SharesAChanceAmongTests) {
    EXPECT_DOUBLE_EQ(chanceOfEach(0.01, 1.0), 0.01);
    for (const double count : {3.0, 1e6}) {
        const double each = chanceOfEach(0.01, count);
        EXPECT_NEAR(-std::expm1(count * std::log1p(-each)), 0.01, 1e-10);
    }
}

}  // namespace
}  // namespace kaustik::judge
