// SPDX-License-Identifier: MIT
// Whole numbers as people type them into a panel's field.
#include "framework/gui/number_fields.h"

#include <gtest/gtest.h>

namespace kaustik::gui {
namespace {

TEST(TypedCounts, ThatFitAreTaken) {
    EXPECT_EQ(typedCount("pictures", "24", 1, 100).value, 24);
    EXPECT_EQ(typedCount("pictures", " 24 ", 1, 100).value, 24);
    EXPECT_EQ(typedCount("pictures", "2e1", 1, 100).value, 20);
    EXPECT_EQ(typedCount("pictures", "24", 1, 100).problem, "");
}

TEST(TypedCounts, ThatAreNoWholeNumbersLeaveAllAsItWasAndSaySo) {
    for (const char* text :
         {"1,5", "1.5", "abc", "", "nan", "1 2", "12px", "  ", "1e-400", "1e400abc"}) {
        const TypedCount typed = typedCount("pictures", text, 1, 100);
        EXPECT_FALSE(typed.value) << text;
        EXPECT_NE(typed.problem.find("pictures takes a whole number from 1 to 100, not '"),
                  std::string::npos)
            << typed.problem;
    }
}

TEST(TypedCounts, BeyondTheEndsBecomeTheNearestAndSaySo) {
    const TypedCount large = typedCount("pictures", "99999999", 1, 100);
    EXPECT_EQ(large.value, 100);
    EXPECT_EQ(large.problem, "pictures takes 1 to 100: of 99999999 it has taken 100.");
    EXPECT_EQ(typedCount("pictures", "1e400", 1, 100).value, 100);
    EXPECT_EQ(typedCount("pictures", "-1e400", 1, 100).value, 1);
    EXPECT_EQ(typedCount("pictures", "inf", 1, 100).value, 100);
    EXPECT_EQ(typedCount("pictures", "0", 1, 100).value, 1);
    EXPECT_EQ(typedCount("pictures", "-5", 1, 100).problem,
              "pictures takes 1 to 100: of -5 it has taken 1.");
}

}  // namespace
}  // namespace kaustik::gui
