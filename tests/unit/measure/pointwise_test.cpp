// SPDX-License-Identifier: MIT
#include "framework/measure/pointwise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

// Two pixels whose values and results are binary fractions, so that results are exact.
struct TwoPixels {
    Image image{2, 1, 3};
    Image reference{2, 1, 3};
    TwoPixels() {
        image.values = {1.0f, 2.0f, 3.0f, 0.5f, 0.0f, 4.0f};
        reference.values = {1.0f, 1.0f, 1.0f, 1.0f, 0.0f, 2.0f};
        // Differences 0, 1, 2, -0.5, 0, 2: squares 0, 1, 4, 0.25, 0, 4.
    }
};

TEST(Pointwise, ErrorsOfTwoPixelsAreThoseWorkedOutByHand) {
    const TwoPixels two;
    const ImagePair pair = pairOf(two.image, two.reference);
    EXPECT_DOUBLE_EQ(rootMeanSquareError(pair), std::sqrt(9.25 / 6.0));
    EXPECT_DOUBLE_EQ(meanAbsoluteError(pair), 5.5 / 6.0);
    // With epsilon 1: 0/2 + 1/2 + 4/2 + 0.25/2 + 0/1 + 4/5.
    EXPECT_DOUBLE_EQ(relativeMeanSquareError(pair, 1.0), 3.425 / 6.0);
    EXPECT_DOUBLE_EQ(energyRatio(pair), 10.5 / 6.0);
    // 0/2 + 1/3 + 2/4 + 0.5/1.5 + 0 where both are black + 2/6.
    EXPECT_DOUBLE_EQ(symmetricRelativeError(pair, litPixels(pair)), 1.5 / 6.0);
    EXPECT_EQ(signedError(pair).values, (std::vector<float>{0, 1, 2, -0.5f, 0, 2}));
    EXPECT_EQ(absoluteError(pair).values, (std::vector<float>{0, 1, 2, 0.5f, 0, 2}));
}

TEST(Pointwise, PixelsThatAreLeftOutChangeNeitherSumNorCount) {
    TwoPixels two;
    two.image.values[5] = 1000.0f;
    Image mask(2, 1, 1);
    mask.values = {1.0f, 0.0f};
    const ImagePair pair({.image = two.image, .reference = two.reference, .mask = &mask});
    EXPECT_DOUBLE_EQ(rootMeanSquareError(pair), std::sqrt(5.0 / 3.0));
    EXPECT_DOUBLE_EQ(meanAbsoluteError(pair), 1.0);
    EXPECT_DOUBLE_EQ(energyRatio(pair), 2.0);
}

TEST(Pointwise, EqualImagesHaveNoErrorAndTheWholeEnergy) {
    const Image image = randomImage(16, 9, 7);
    const ImagePair pair = pairOf(image, image);
    EXPECT_EQ(rootMeanSquareError(pair), 0.0);
    EXPECT_EQ(meanAbsoluteError(pair), 0.0);
    EXPECT_EQ(relativeMeanSquareError(pair, 1e-6), 0.0);
    EXPECT_EQ(energyRatio(pair), 1.0);
}

// A bright pixel that is right and nine weak ones, a millionth as bright, of which all is missing.
TEST(Pointwise, SmapeSeesMissingWeakLight) {
    Image reference = greyImage(10, 1, 1e-3f);
    for (std::size_t i = 0; i < 3; ++i)
        reference.values[i] = 1e3f;
    Image image = greyImage(10, 1, 0.0f);
    for (std::size_t i = 0; i < 3; ++i)
        image.values[i] = 1e3f;
    const ImagePair pair = pairOf(image, reference);
    EXPECT_DOUBLE_EQ(symmetricRelativeError(pair, litPixels(pair)), 0.9);
    EXPECT_LT(relativeMeanSquareError(pair, relMseEpsilon(referenceScale(pair))), 1e-9);
    EXPECT_NEAR(energyRatio(pair), 1.0, 1e-5);
}

TEST(Pointwise, SmapeOfLightTwiceTooMuchIsAThirdAndOfAnyScaleTheSame) {
    const Image reference = randomImage(16, 9, 7, 0.5f, 2.0f);
    for (const float factor : {1.0f, 1024.0f}) {
        const ImagePair pair = pairOf(scaled(reference, 2.0f * factor), scaled(reference, factor));
        // Roundings of 1e-16 in each of 432 additions.
        EXPECT_NEAR(symmetricRelativeError(pair, litPixels(pair)), 1.0 / 3.0, 1e-13);
    }
}

// Luminances 3.1, 3, 3.1 and 0 with a standard error of 1; the third does not count.
TEST(LitPixels, ExceedThreeStandardErrorsAndCount) {
    Image reference(4, 1, 3);
    reference.values = {3.1f, 3.1f, 3.1f, 3.0f, 3.0f, 3.0f, 3.1f, 3.1f, 3.1f, 0.0f, 0.0f, 0.0f};
    const Image sigma = greyImage(4, 1, 1.0f);
    Image mask(4, 1, 1);
    mask.values = {1.0f, 1.0f, 0.0f, 1.0f};
    const ImagePair noisy(
        {.image = reference, .reference = reference, .mask = &mask, .standardError = &sigma});
    EXPECT_EQ(litPixels(noisy), (std::vector<unsigned char>{1, 0, 0, 0}));
    EXPECT_EQ(litPixels(pairOf(reference, reference)), (std::vector<unsigned char>{1, 1, 1, 0}));
}

TEST(Pointwise, AreasTurnIrradianceIntoFlux) {
    const TwoPixels two;
    Image area(2, 1, 1);
    area.values = {3.0f, 0.5f};
    const ImagePair pair({.image = two.image, .reference = two.reference, .area = &area});
    EXPECT_DOUBLE_EQ(totalFlux(pair, pair.image()), 3.0 * 6.0 + 0.5 * 4.5);
    EXPECT_DOUBLE_EQ(energyRatio(pair), 20.25 / 10.5);
}

// 6.3 million additions of 0.1 in 64 bits are off by 7e-10 of it at worst; in 32 bits they are by
// several per cent.
TEST(Pointwise, SumsDoNotDriftOverManyPixels) {
    const ImagePair pair = pairOf(greyImage(2048, 1024, 0.1f), greyImage(2048, 1024, 0.0f));
    const double tenth = static_cast<double>(0.1f);
    EXPECT_NEAR(meanAbsoluteError(pair), tenth, 7e-11);
    EXPECT_NEAR(rootMeanSquareError(pair), tenth, 7e-11);
}

TEST(Pointwise, ErrorsFarBeyondTheRangeOfFloatSquaresStayFinite) {
    const ImagePair pair = pairOf(greyImage(2, 2, 3e38f), greyImage(2, 2, 1e38f));
    EXPECT_NEAR(rootMeanSquareError(pair) / 2e38, 1.0, 1e-6);
}

TEST(Pointwise, RelMseIsTheSameForAnySceneScale) {
    const Image image = randomImage(32, 32, 3);
    const Image reference = randomImage(32, 32, 4);
    const auto relMse = [&](float factor) {
        const ImagePair pair = pairOf(scaled(image, factor), scaled(reference, factor));
        return relativeMeanSquareError(pair, relMseEpsilon(referenceScale(pair)));
    };
    // Powers of two only shift exponents.
    EXPECT_DOUBLE_EQ(relMse(1024.0f), relMse(1.0f));
    EXPECT_DOUBLE_EQ(relMse(1.0f / 1024.0f), relMse(1.0f));
}

// A perfect image measured against many references that are noisy with the stated error.
TEST(ReferenceNoise, IsWhatNoisyReferencesGiveAPerfectImage) {
    constexpr int kTrials = 400;
    const Image reference = randomImage(12, 10, 5, 1.0f, 2.0f);
    const Image sigma = randomImage(12, 10, 6, 0.05f, 0.1f);
    const ImagePair stated({.image = reference, .reference = reference, .standardError = &sigma});
    const double epsilon = 0.01;
    const std::vector<unsigned char> lit = litPixels(stated);
    const ReferenceNoise expected = referenceNoise(stated, epsilon, lit);

    std::mt19937 generator(11);
    std::normal_distribution<float> normal;
    double squares = 0.0;
    double absolutes = 0.0;
    double relative = 0.0;
    double symmetric = 0.0;
    double ratioSquares = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
        Image noisy = reference;
        for (std::size_t pixel = 0; pixel < 120; ++pixel) {
            const float deviation = normal(generator);  // one for all channels, as of photons
            for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
                noisy.values[i] += sigma.values[i] * deviation;
        }
        // Measured the other way round, so that R in relMSE is the same for all.
        const ImagePair pair = pairOf(noisy, reference);
        squares += std::pow(rootMeanSquareError(pair), 2.0) / kTrials;
        absolutes += meanAbsoluteError(pair) / kTrials;
        relative += relativeMeanSquareError(pair, epsilon) / kTrials;
        symmetric += symmetricRelativeError(pair, lit) / kTrials;
        ratioSquares += std::pow(energyRatio(pair) - 1.0, 2.0) / kTrials;
    }
    // The spread of a mean of squares over n independent samples is sqrt(2/n) of it: 0.0065 for the
    // 48,000 pixels, 0.071 for the 400 energies. Five times that; half for a root.
    EXPECT_NEAR(std::sqrt(squares) / expected.rmse, 1.0, 0.017);
    EXPECT_NEAR(absolutes / expected.mae, 1.0, 0.033);
    EXPECT_NEAR(relative / expected.relMse, 1.0, 0.033);
    // That I + R is 2 R holds to first order; the second is (σ / R)² / 4, below 0.0025.
    EXPECT_NEAR(symmetric / expected.smape, 1.0, 0.033 + 0.0025);
    EXPECT_NEAR(std::sqrt(ratioSquares) / expected.energyRatio, 1.0, 0.18);
}

TEST(ReferenceNoise, OfPixelsThatAreLeftOutDoesNotCount) {
    const Image image = greyImage(2, 1, 1.0f);
    Image sigma(2, 1, 3);
    sigma.values = {0.5f, 0.5f, 0.5f, 100.0f, 100.0f, 100.0f};
    Image mask(2, 1, 1);
    mask.values = {1.0f, 0.0f};
    const ImagePair pair(
        {.image = image, .reference = image, .mask = &mask, .standardError = &sigma});
    const ReferenceNoise noise = referenceNoise(pair, 1.0, {1, 0});
    EXPECT_DOUBLE_EQ(noise.rmse, 0.5);
    EXPECT_DOUBLE_EQ(noise.relMse, 0.125);
    EXPECT_NEAR(noise.smape, 0.7978845608 * 0.25, 1e-9);
    EXPECT_DOUBLE_EQ(noise.energyRatio, 0.5);
}

}  // namespace
}  // namespace kaustik::measure::test
