// SPDX-License-Identifier: MIT
#include "framework/measure/flip_hdr.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/measure/flip_from_paper.h"
#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

// The curve as it is usually printed, with the paper's 0.6 before it.
double acesOf(double linear) {
    const double x = 0.6 * linear;
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

double meanHdr(const Image& image, const Image& reference, const ExposureRange& range) {
    const ImagePair pair = pairOf(image, reference);
    return pooledMean(pair, hdrFlipMap(pair, range));
}

TEST(ToneMap, IsTheAcesFitFromBlackToWhite) {
    for (const double x : {0.0, 1e-6, 0.01, 0.18, 1.0, 4.0, 12.0, 13.0})
        EXPECT_NEAR(toneMap(x), acesOf(x), 1e-15) << x;
    EXPECT_EQ(toneMap(1e300), 1.0);
    EXPECT_EQ(toneMap(std::numeric_limits<double>::infinity()), 1.0);
}

TEST(Exposures, ByDefaultShowTheBrightestAndTheFaintestThatMattersAsTheSameGrey) {
    ReferenceScale scale;
    scale.brightest = 300.0;
    scale.white = 50.0;
    scale.typical = 10.0;
    scale.faint = 0.7;
    const ExposureRange range = defaultExposures(scale);
    EXPECT_NEAR(acesOf(300.0 * std::exp2(range.start)), 0.85, 1e-12);
    EXPECT_NEAR(acesOf(0.7 * std::exp2(range.stop)), 0.85, 1e-12);
    // log2(300/0.7) = 8.74 stops.
    EXPECT_EQ(range.count, 9);
    EXPECT_EQ(range.at(0), range.start);
    EXPECT_DOUBLE_EQ(range.at(8), range.stop);
    EXPECT_NEAR(range.at(2), range.start + 8.743 * 2 / 8, 1e-3);
}

TEST(Exposures, OfAMostlyBlackReferenceAreFinite) {
    Image reference = greyImage(100, 100, 0.0f);
    for (int c = 0; c < 3; ++c)
        reference.at(50, 50, c) = 4.0f;
    const ExposureRange range = defaultExposures(referenceScale(pairOf(reference, reference)));
    EXPECT_TRUE(std::isfinite(range.start));
    EXPECT_DOUBLE_EQ(range.start, range.stop);
    EXPECT_EQ(range.count, 2);
}

TEST(HdrFlip, OfEqualImagesIsZero) {
    const Image image = randomImage(20, 20, 1, 0.0f, 100.0f);
    EXPECT_EQ(meanHdr(image, image, {-8.0, 2.0, 10}), 0.0);
}

TEST(HdrFlip, OfTwoConstantsIsTheLargestOverTheExposuresByThePapersFormulas) {
    const ExposureRange range{-4.0, 3.0, 8};
    double expected = 0.0;
    double previous = 0.0;
    int rises = 0;
    for (int i = 0; i < 8; ++i) {
        const double gain = std::exp2(-4.0 + i);
        const double a = acesOf(2.0 * gain);
        const double b = acesOf(2.5 * gain);
        const double flip = flipOfConstants({a, a, a}, {b, b, b});
        rises += flip > previous ? 1 : 0;
        previous = flip;
        expected = std::max(expected, flip);
    }
    // The largest is neither at the first exposure nor at the last, so that all have to be looked
    // at.
    ASSERT_GT(rises, 1);
    ASSERT_LT(rises, 8);
    EXPECT_NEAR(meanHdr(greyImage(24, 24, 2.0f), greyImage(24, 24, 2.5f), range), expected, 1e-5);
}

TEST(HdrFlip, InEachPixelIsTheLargestOfItsExposures) {
    const Image a = randomImage(30, 20, 1, 0.0f, 10.0f);
    const Image b = randomImage(30, 20, 2, 0.0f, 10.0f);
    const ImagePair pair = pairOf(a, b);
    Plane<float> largest(30, 20);
    for (const double exposure : {-3.0, -1.0, 1.0}) {
        const Plane<float> one = hdrFlipMap(pair, {exposure, exposure, 1});
        for (std::size_t i = 0; i < one.values.size(); ++i)
            largest.values[i] = std::max(largest.values[i], one.values[i]);
    }
    EXPECT_EQ(hdrFlipMap(pair, {-3.0, 1.0, 3}).values, largest.values);
}

TEST(HdrFlip, SeesAnErrorThatOneExposureCutsOff) {
    // Both are far above the white of a picture that shows the environment.
    Image reference = greyImage(40, 40, 0.5f);
    Image image = reference;
    for (int y = 15; y < 25; ++y) {
        for (int x = 15; x < 25; ++x) {
            for (int c = 0; c < 3; ++c) {
                reference.at(x, y, c) = 40.0f;
                image.at(x, y, c) = 80.0f;
            }
        }
    }
    const ImagePair pair = pairOf(image, reference);
    EXPECT_EQ(pooledMean(pair, ldrFlipMap(pair, 1.0)), 0.0);
    EXPECT_GT(pooledMean(pair, hdrFlipMap(pair, defaultExposures(referenceScale(pair)))), 0.01);
}

TEST(HdrFlip, IsTheSameForAnySceneScale) {
    const Image a = randomImage(30, 20, 1, 0.0f, 10.0f);
    const Image b = randomImage(30, 20, 2, 0.0f, 10.0f);
    const auto value = [&](float factor) {
        const ImagePair pair = pairOf(scaled(a, factor), scaled(b, factor));
        return pooledMean(pair, hdrFlipMap(pair, defaultExposures(referenceScale(pair))));
    };
    // Exposures are logarithms: their rounding moves what is shown by a few 1e-15.
    EXPECT_NEAR(value(1048576.0f), value(1.0f), 1e-6);
    EXPECT_NEAR(value(1.0f / 1048576.0f), value(1.0f), 1e-6);
}

TEST(HdrFlip, OfTheLargestAndSmallestFloatsIsFinite) {
    const float tiny = std::numeric_limits<float>::denorm_min();
    const float huge = std::numeric_limits<float>::max();
    const ImagePair pair = pairOf(greyImage(4, 4, huge), greyImage(4, 4, tiny));
    const double value = pooledMean(pair, hdrFlipMap(pair, defaultExposures(referenceScale(pair))));
    EXPECT_GT(value, 0.0);
    EXPECT_LE(value, 1.0);
}

}  // namespace
}  // namespace kaustik::measure::test
