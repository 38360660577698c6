// SPDX-License-Identifier: MIT
#include "framework/image/eight_bits.h"

#include <gtest/gtest.h>

#include <limits>

namespace kaustik {
namespace {

TEST(EightBits, RoundToTheNearestOf256Values) {
    Image image(4, 1, 1);
    image.values = {0.0f, 100.4f / 255.0f, 100.6f / 255.0f, 1.0f};
    EXPECT_EQ(toEightBits(image), (std::vector<unsigned char>{0, 100, 101, 255}));
}

TEST(EightBits, ClampWhatIsOutOfRangeAndShowNotANumberAsBlack) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Image image(5, 1, 1);
    image.values = {-3.0f, 7.0f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
    EXPECT_EQ(toEightBits(image), (std::vector<unsigned char>{0, 255, 255, 0, 0}));
}

}  // namespace
}  // namespace kaustik
