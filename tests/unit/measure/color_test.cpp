// SPDX-License-Identifier: MIT
#include "framework/measure/color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kaustik::measure::test {
namespace {

TEST(CubeRoot, IsThatOfTheStandardLibraryToTwoUnitsInTheLastPlace) {
    for (double exponent = -30.0; exponent <= 30.0; exponent += 0.01) {
        const auto value = static_cast<float>(std::pow(10.0, exponent));
        const double exact = std::cbrt(static_cast<double>(value));
        EXPECT_NEAR(static_cast<double>(cubeRoot(value)) / exact, 1.0, 2.4e-7) << value;
    }
}

TEST(Srgb, DecodesWhatItEncodes) {
    EXPECT_EQ(encodeSrgb(0.0), 0.0);
    EXPECT_DOUBLE_EQ(encodeSrgb(1.0), 1.0);
    EXPECT_NEAR(encodeSrgb(0.214041), 0.5, 1e-6);  // half the code values are 21 % of the light
    for (const double x : {0.0001, 0.003, 0.0032, 0.18, 0.9})
        EXPECT_NEAR(decodeSrgb(encodeSrgb(x)), x, 1e-12);
    Image rgba(1, 1, 4);
    rgba.values = {0.5f, 1.0f, 0.0f, 0.5f};
    const Image linear = decodeSrgb(rgba);
    EXPECT_NEAR(linear.values[0], 0.214041f, 1e-6f);
    EXPECT_EQ(linear.values[3], 0.5f);  // alpha is no light
}

}  // namespace
}  // namespace kaustik::measure::test
