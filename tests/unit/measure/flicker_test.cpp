// SPDX-License-Identifier: MIT
#include "framework/measure/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

ImagePair withError(const Image& image, const Image& reference, const Image& standardError,
                    const Image* mask = nullptr) {
    return ImagePair(
        {.image = image, .reference = reference, .mask = mask, .standardError = &standardError});
}

// The value of every pixel and normal noise on it, the same in all channels, as photons make it.
Image noisy(float value, double standardError, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0.0, standardError);
    Image image = greyImage(64, 48, value);
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        const auto off = static_cast<float>(noise(generator));
        for (std::size_t c = 0; c < 3; ++c)
            image.values[i + c] += off;
    }
    return image;
}

// Binary fractions, so that sums are exact.
TEST(Flicker, OfTwoPixelsIsThatWorkedOutByHand) {
    Image first(2, 1, 3);
    Image second(2, 1, 3);
    first.values = {1, 2, 3, 4, 5, 6};
    second.values = {1, 3, 5, 4, 5, 3};  // changes 0, 1, 2, 0, 0, -3: squares sum to 14
    Image truthFirst(2, 1, 3);
    Image truthSecond(2, 1, 3);
    truthFirst.values = {1, 1, 1, 8, 8, 8};
    truthSecond.values = {3, 1, 1, 8, 8, 4};  // 2, 0, 0, 0, 0, -4: 20
    const Image half = greyImage(2, 1, 0.5f);
    const Flicker flicker =
        measureFlicker(withError(first, truthFirst, half), withError(second, truthSecond, half));
    EXPECT_DOUBLE_EQ(flicker.rms, std::sqrt(14.0 / 6.0));
    // Twice 0.25 is taken off each.
    EXPECT_DOUBLE_EQ(flicker.truthRms, std::sqrt(17.0 / 6.0));
    EXPECT_DOUBLE_EQ(flicker.difference(), std::sqrt(14.0 / 6.0) - std::sqrt(17.0 / 6.0));
    EXPECT_EQ(flicker.countedPixels, 2u);
    // A square's deviation is sqrt(2 0.5² + 4 0.5 change²): with changes of 3.5 and 15.5 beside
    // those of none.
    const double none = std::sqrt(0.5);
    const double left = std::sqrt(0.5 + 2.0 * 3.5) + 2.0 * none;
    const double right = 2.0 * none + std::sqrt(0.5 + 2.0 * 15.5);
    const double ofMean = std::sqrt(left * left + right * right) / 6.0;
    EXPECT_DOUBLE_EQ(flicker.truthStandardError,
                     std::sqrt(17.0 / 6.0 + ofMean) - std::sqrt(17.0 / 6.0));
}

TEST(Flicker, OfNoChangeAndNoNoiseIsZero) {
    const Image image = randomImage(16, 9, 3);
    const Image none = greyImage(16, 9, 0.0f);
    const Flicker flicker =
        measureFlicker(withError(image, image, none), withError(image, image, none));
    EXPECT_EQ(flicker.rms, 0.0);
    EXPECT_EQ(flicker.truthRms, 0.0);
    EXPECT_EQ(flicker.truthStandardError, 0.0);
}

TEST(Flicker, LeavesOutWhatTheMaskDoes) {
    Image first = greyImage(2, 1, 1.0f);
    Image second = greyImage(2, 1, 2.0f);
    second.values[3] = 1000.0f;
    const Image none = greyImage(2, 1, 0.0f);
    Image mask(2, 1, 1);
    mask.values = {1.0f, 0.0f};
    const Flicker flicker = measureFlicker(withError(first, first, none, &mask),
                                           withError(second, second, none, &mask));
    EXPECT_DOUBLE_EQ(flicker.rms, 1.0);
    EXPECT_DOUBLE_EQ(flicker.truthRms, 1.0);
    EXPECT_EQ(flicker.countedPixels, 1u);
}

// The references' noise would be taken for a change of sqrt(2) of its size.
TEST(Flicker, OfAStillTruthIsNoneWhateverItsNoise) {
    const double sigma = 5.0;
    const Image error = greyImage(64, 48, 5.0f);
    const Image image = greyImage(64, 48, 100.0f);
    int beyondThree = 0;
    double signedSum = 0.0;
    for (unsigned seed = 0; seed < 50; ++seed) {
        const Image first = noisy(100.0f, sigma, 2 * seed);
        const Image second = noisy(100.0f, sigma, 2 * seed + 1);
        const Flicker flicker =
            measureFlicker(withError(image, first, error), withError(image, second, error));
        EXPECT_LT(flicker.truthRms, 0.3 * sigma * std::sqrt(2.0)) << seed;
        const double bound = std::pow(flicker.truthRms + flicker.truthStandardError, 2.0);
        const double ofSquare = bound - std::pow(flicker.truthRms, 2.0);
        if (std::pow(flicker.truthRms, 2.0) > 3.0 * ofSquare) ++beyondThree;
        signedSum += flicker.truthRms > 0.0 ? 1.0 : -1.0;
    }
    EXPECT_LE(beyondThree, 1);
    // As often above zero as below, where it is cut off: 50 coins, four deviations.
    EXPECT_LT(std::abs(signedSum), 4.0 * std::sqrt(50.0));
}

// The change is found without bias, and its scatter over many references is the standard error that
// each of them states.
TEST(Flicker, OfTheTruthIsRightToItsStandardError) {
    const double sigma = 5.0;
    const float change = 4.0f;
    const Image error = greyImage(64, 48, 5.0f);
    const Image image = greyImage(64, 48, 100.0f);
    double sum = 0.0;
    double squares = 0.0;
    double stated = 0.0;
    constexpr int kCount = 200;
    for (unsigned seed = 0; seed < kCount; ++seed) {
        const Image first = noisy(100.0f, sigma, 1000 + 2 * seed);
        const Image second = noisy(100.0f + change, sigma, 1001 + 2 * seed);
        const Flicker flicker =
            measureFlicker(withError(image, first, error), withError(image, second, error));
        sum += flicker.truthRms;
        squares += flicker.truthRms * flicker.truthRms;
        stated += flicker.truthStandardError;
    }
    const double mean = sum / kCount;
    const double scatter = std::sqrt(squares / kCount - mean * mean);
    // The mean of 200 is known to a fourteenth of its scatter; a root of a noisy square is biased
    // by far less.
    EXPECT_NEAR(mean, 4.0, 4.0 * scatter / std::sqrt(200.0));
    // Changes of single pixels are below their noise here, and those that noise makes negative
    // count as none, which states up to a third too much, and never too little; the scatter itself
    // is known to 5 %.
    EXPECT_GT(stated / kCount, 0.85 * scatter);
    EXPECT_LT(stated / kCount, 1.5 * scatter);
}

}  // namespace
}  // namespace kaustik::measure::test
