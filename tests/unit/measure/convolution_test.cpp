// SPDX-License-Identifier: MIT
#include "framework/measure/convolution.h"

#include <gtest/gtest.h>

#include <numeric>

namespace kaustik::measure::test {
namespace {

Plane<double> row(const std::vector<double>& values) {
    Plane<double> plane(static_cast<int>(values.size()), 1);
    plane.values = values;
    return plane;
}

Plane<double> column(const std::vector<double>& values) {
    Plane<double> plane(1, static_cast<int>(values.size()));
    plane.values = values;
    return plane;
}

TEST(Convolution, AddsWeightedNeighboursAndGoesOnWithTheNearestPixelBeyondTheBorder) {
    const Kernel kernel{Kernel::Kind::even, {0.5, 0.25, 0.125}};
    const std::vector<double> values{1.0, 2.0, 4.0, 8.0};
    // 0.5·1 + 0.25·(1+2) + 0.125·(1+4), then 0.5·2 + 0.25·(1+4) + 0.125·(1+8), and so on.
    const std::vector<double> expected{1.875, 3.375, 5.625, 8.25};
    EXPECT_EQ(convolveRows(row(values), kernel).values, expected);
    EXPECT_EQ(convolveColumns(column(values), kernel).values, expected);
}

TEST(Convolution, WithAnOddKernelIsADifference) {
    const Kernel kernel{Kernel::Kind::odd, {0.0, 1.0}};
    const std::vector<double> expected{1.0, 3.0, 6.0, 4.0};
    EXPECT_EQ(convolveRows(row({1.0, 2.0, 4.0, 8.0}), kernel).values, expected);
    EXPECT_EQ(convolveColumns(column({1.0, 2.0, 4.0, 8.0}), kernel).values, expected);
}

TEST(Convolution, WithAnEvenKernelOfSumZeroIsASecondDifference) {
    const Kernel kernel{Kernel::Kind::evenZeroSum, {-2.0, 1.0}};
    const std::vector<double> expected{1.0, 1.0, 2.0, -4.0};
    EXPECT_EQ(convolveRows(row({1.0, 2.0, 4.0, 8.0}), kernel).values, expected);
}

TEST(Convolution, WithKernelsOfSumZeroMakesAConstantExactlyZero) {
    Plane<float> constant(7, 5);
    std::fill(constant.values.begin(), constant.values.end(), 0.7f);
    const Kernel second{Kernel::Kind::evenZeroSum, {-0.2, -0.35, 0.2, 0.25}};
    const Kernel first{Kernel::Kind::odd, {0.0, 0.3, 0.1}};
    for (const Kernel& kernel : {first, second}) {
        EXPECT_EQ(convolveRows(constant, kernel).values, std::vector<float>(35, 0.0f));
        EXPECT_EQ(convolveColumns(constant, kernel).values, std::vector<float>(35, 0.0f));
    }
}

TEST(Convolution, WithAKernelWiderThanTheImageIsDefined) {
    const Kernel kernel = gaussianKernel(4.0, 12);
    // All weights add up to 1, to within the rounding of 25 additions.
    EXPECT_NEAR(convolveRows(row({3.0}), kernel).values[0], 3.0, 1e-14);
    EXPECT_NEAR(convolveColumns(column({3.0, 3.0}), kernel).values[1], 3.0, 1e-14);
}

}  // namespace
}  // namespace kaustik::measure::test
