// SPDX-License-Identifier: MIT
#include "framework/measure/ssim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

Plane<double> randomPlane(int width, int height, unsigned seed) {
    Plane<double> plane(width, height);
    const Image image = randomImage(width, height, seed);
    for (std::size_t i = 0; i < plane.values.size(); ++i)
        plane.values[i] = static_cast<double>(image.values[i]);
    return plane;
}

TEST(Ssim, OfEqualImagesIsOne) {
    const Image image = randomImage(32, 24, 1);
    EXPECT_DOUBLE_EQ(*ssim(pairOf(image, image), 1.0), 1.0);
}

TEST(Ssim, OfTwoConstantsIsTheLuminanceTermAlone) {
    // Linear 0.0225 and 0.64 are these on a display (IEC 61966-2-1).
    const double x = 1.055 * std::pow(0.0225, 1.0 / 2.4) - 0.055;
    const double y = 1.055 * std::pow(0.64, 1.0 / 2.4) - 0.055;
    const double expected = (2.0 * x * y + 1e-4) / (x * x + y * y + 1e-4);
    const ImagePair pair = pairOf(greyImage(16, 16, 0.0225f), greyImage(16, 16, 0.64f));
    // Inputs are floats: 6e-8 relative.
    EXPECT_NEAR(*ssim(pair, 1.0), expected, 1e-6);
    // Twice as bright, on a display whose white is twice as bright, is the same picture.
    const ImagePair brighter = pairOf(greyImage(16, 16, 0.045f), greyImage(16, 16, 1.28f));
    EXPECT_NEAR(*ssim(brighter, 2.0), expected, 1e-6);
}

// Equation 13 with the 121 weights of the window written out, without separating them.
TEST(Ssim, InThePixelIsThePapersFormulaOverAllWeightsOfTheWindow) {
    const Plane<double> x = randomPlane(13, 15, 1);
    const Plane<double> y = randomPlane(13, 15, 2);
    const Plane<double> map = ssimMap(x, y);
    double weightSum = 0.0, meanX = 0.0, meanY = 0.0;
    const auto weight = [](int i, int j) { return std::exp(-(i * i + j * j) / (2.0 * 2.25)); };
    for (int j = -5; j <= 5; ++j) {
        for (int i = -5; i <= 5; ++i) {
            weightSum += weight(i, j);
            meanX += weight(i, j) * x.row(8 + j)[6 + i];
            meanY += weight(i, j) * y.row(8 + j)[6 + i];
        }
    }
    meanX /= weightSum;
    meanY /= weightSum;
    double varianceX = 0.0, varianceY = 0.0, covariance = 0.0;
    for (int j = -5; j <= 5; ++j) {
        for (int i = -5; i <= 5; ++i) {
            const double dx = x.row(8 + j)[6 + i] - meanX;
            const double dy = y.row(8 + j)[6 + i] - meanY;
            varianceX += weight(i, j) * dx * dx / weightSum;
            varianceY += weight(i, j) * dy * dy / weightSum;
            covariance += weight(i, j) * dx * dy / weightSum;
        }
    }
    const double expected =
        (2.0 * meanX * meanY + 1e-4) * (2.0 * covariance + 9e-4) /
        ((meanX * meanX + meanY * meanY + 1e-4) * (varianceX + varianceY + 9e-4));
    EXPECT_NEAR(map.row(8)[6], expected, 1e-12);
}

TEST(Ssim, IsSymmetricAndFallsAsNoiseGrows) {
    const Image reference = randomImage(40, 40, 1);
    const Image noise = randomImage(40, 40, 2, -0.5f, 0.5f);
    double previous = 1.0;
    for (const float amount : {0.05f, 0.1f, 0.2f, 0.4f, 0.8f}) {
        Image image = reference;
        for (std::size_t i = 0; i < image.values.size(); ++i)
            image.values[i] += amount * noise.values[i];
        const double value = *ssim(pairOf(image, reference), 1.0);
        EXPECT_LT(value, previous) << amount;
        EXPECT_DOUBLE_EQ(*ssim(pairOf(reference, image), 1.0), value);
        previous = value;
    }
}

TEST(Ssim, OfANegativeIsBelowZero) {
    Plane<double> x = randomPlane(21, 21, 3);
    Plane<double> y = x;
    for (double& value : y.values)
        value = 1.0 - value;
    EXPECT_LT(ssimMap(x, y).row(10)[10], -0.5);
}

TEST(Ssim, DoesNotExistWhereNoWindowLiesInside) {
    const Image small = randomImage(10, 40, 1);
    EXPECT_FALSE(ssim(pairOf(small, small), 1.0));
    const Image justLargeEnough = randomImage(11, 11, 1);
    EXPECT_TRUE(ssim(pairOf(justLargeEnough, justLargeEnough), 1.0));
}

TEST(Ssim, IsTheMeanOverCountedPixelsOnly) {
    Image image = randomImage(60, 20, 1);
    const Image reference = image;
    for (int y = 0; y < 20; ++y) {
        for (int x = 30; x < 60; ++x)
            image.at(x, y, 1) = 0.0f;
    }
    Image mask(60, 20, 1);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 30; ++x)
            mask.at(x, y, 0) = 1.0f;
    }
    const ImagePair half({.image = image, .reference = reference, .mask = &mask});
    EXPECT_LT(*ssim(pairOf(image, reference), 1.0), 0.9);
    EXPECT_DOUBLE_EQ(*ssim(half, 1.0), 1.0);
}

}  // namespace
}  // namespace kaustik::measure::test
