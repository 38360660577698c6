// SPDX-License-Identifier: MIT
#include "framework/measure/flip.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/measure/flip_from_paper.h"
#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

double meanFlip(const Image& image, const Image& reference,
                double pixelsPerDegree = kFlipPixelsPerDegree) {
    const ImagePair pair = pairOf(image, reference);
    return pooledMean(pair, ldrFlipMap(pair, 1.0, pixelsPerDegree));
}

PaperImage paperImage(const Image& image) {
    PaperImage result;
    result.width = image.width;
    result.height = image.height;
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        result.rgb.push_back({static_cast<double>(image.values[i]),
                              static_cast<double>(image.values[i + 1]),
                              static_cast<double>(image.values[i + 2])});
    }
    return result;
}

Image checkerboard(int width, int height, int squarePixels, float dark, float bright) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = (x / squarePixels + y / squarePixels) % 2 == 0 ? dark : bright;
        }
    }
    return image;
}

// Largest errors of the fast filters, in 32 bits: a few 1e-7 of a feature's strength, whose root
// changes the exponent by less than 1e-4 where there is a feature.
constexpr double kTolerance = 2e-4;

TEST(Flip, OfEqualImagesIsExactlyZeroEverywhere) {
    const Image image = randomImage(50, 40, 1);
    const ImagePair pair = pairOf(image, image);
    const Plane<float> map = ldrFlipMap(pair, 1.0);
    EXPECT_TRUE(std::all_of(map.values.begin(), map.values.end(), [](float v) { return v == 0; }));
}

// |ΔL*| = 100, and 203.3 from green to blue (Hunt-adjusted): 100^0.7 = 25.12 lies above the knee
// at 0.4 of 203.3^0.7 = 41.28, so that 0.95 + 0.05 (25.12 - 16.51)/(41.28 - 16.51) = 0.9674.
TEST(Flip, OfBlackAndWhiteIsTheWellKnownValue) {
    EXPECT_NEAR(flipOfConstants({0, 0, 0}, {1, 1, 1}), 0.9674, 5e-5);
    EXPECT_NEAR(meanFlip(greyImage(30, 30, 0.0f), greyImage(30, 30, 1.0f)), 0.9674, 5e-5);
}

TEST(Flip, OfGreenAndBlueIsOneTheLargestThereIs) {
    EXPECT_NEAR(meanFlip(constantImage(30, 30, {0, 1, 0}), constantImage(30, 30, {0, 0, 1})), 1.0,
                1e-5);
}

TEST(Flip, OfTwoConstantColorsIsTheirDistanceByThePapersFormulas) {
    const std::array<float, 3> colors[] = {
        {0.1f, 0.1f, 0.1f}, {0.2f, 0.5f, 0.9f}, {0.9f, 0.3f, 0.05f},  {0.001f, 0.002f, 0.0f},
        {1.0f, 0.0f, 1.0f}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.49f, 0.51f}, {0.0f, 0.0f, 0.0f}};
    for (const auto& a : colors) {
        for (const auto& b : colors) {
            const Vec3 a64{static_cast<double>(a[0]), static_cast<double>(a[1]),
                           static_cast<double>(a[2])};
            const Vec3 b64{static_cast<double>(b[0]), static_cast<double>(b[1]),
                           static_cast<double>(b[2])};
            // There are no features, hence no roots of small errors.
            EXPECT_NEAR(meanFlip(constantImage(24, 24, a), constantImage(24, 24, b)),
                        flipOfConstants(a64, b64), 1e-5);
        }
    }
}

TEST(Flip, InEachPixelIsThePapersFormulaWithWholeKernels) {
    // Smaller than the kernels, so that borders matter everywhere.
    const Image a = randomImage(17, 11, 1);
    const Image b = randomImage(17, 11, 2);
    for (const double ppd : {20.0, 67.0}) {
        const Plane<float> map = ldrFlipMap(pairOf(a, b), 1.0, ppd);
        for (const auto& [x, y] : {std::pair{0, 0}, {8, 5}, {16, 10}, {3, 9}, {12, 0}}) {
            EXPECT_NEAR(static_cast<double>(map.row(y)[x]),
                        flipFromPaper(paperImage(a), paperImage(b), x, y, ppd), kTolerance)
                << x << ", " << y << " at " << ppd;
        }
    }
}

TEST(Flip, AtAnEdgeIsThePapersFormulaWithWholeKernels) {
    Image a = greyImage(24, 24, 0.2f);
    for (int y = 0; y < 24; ++y) {
        for (int x = 12; x < 24; ++x)
            a.at(x, y, 0) = a.at(x, y, 1) = 0.8f;
    }
    const Image b = greyImage(24, 24, 0.3f);
    const Plane<float> map = ldrFlipMap(pairOf(a, b), 1.0);
    for (const int x : {2, 10, 11, 12, 14, 20}) {
        EXPECT_NEAR(static_cast<double>(map.row(12)[x]),
                    flipFromPaper(paperImage(a), paperImage(b), x, 12, 67.0), kTolerance)
            << x;
    }
}

TEST(Flip, IsTheSameWhenImageAndReferenceAreSwapped) {
    const Image a = randomImage(40, 30, 1);
    const Image b = randomImage(40, 30, 2);
    EXPECT_EQ(ldrFlipMap(pairOf(a, b), 1.0).values, ldrFlipMap(pairOf(b, a), 1.0).values);
}

TEST(Flip, OfMirroredImagesIsTheMirroredMap) {
    const auto mirrored = [](const Image& image) {
        Image result = image;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                for (int c = 0; c < 3; ++c)
                    result.at(x, y, c) = image.at(image.width - 1 - x, y, c);
            }
        }
        return result;
    };
    const Image a = randomImage(40, 30, 1);
    const Image b = randomImage(40, 30, 2);
    const Plane<float> map = ldrFlipMap(pairOf(a, b), 1.0);
    const Plane<float> other = ldrFlipMap(pairOf(mirrored(a), mirrored(b)), 1.0);
    for (int x = 0; x < 40; ++x)
        EXPECT_EQ(map.row(7)[x], other.row(7)[39 - x]);
}

TEST(Flip, GrowsWithTheDifference) {
    double previous = 0.0;
    for (const float grey : {0.21f, 0.25f, 0.4f, 0.7f, 1.0f}) {
        const double value = meanFlip(greyImage(24, 24, grey), greyImage(24, 24, 0.2f));
        EXPECT_GT(value, previous) << grey;
        previous = value;
    }
}

TEST(Flip, OfAFinePatternFadesWithTheDistanceOfTheViewer) {
    const Image pattern = checkerboard(64, 64, 2, 0.4f, 0.6f);
    const Image grey = greyImage(64, 64, 0.5f);
    const double close = meanFlip(pattern, grey, 10.0);
    const double usual = meanFlip(pattern, grey, 67.0);
    const double far = meanFlip(pattern, grey, 300.0);
    EXPECT_GT(close, 2.0 * usual);
    EXPECT_GT(usual, far);
}

TEST(Flip, RaisesADifferenceWhereAnEdgeIsMissing) {
    Image edge = greyImage(48, 48, 0.3f);
    for (int y = 0; y < 48; ++y) {
        for (int x = 24; x < 48; ++x) {
            for (int c = 0; c < 3; ++c)
                edge.at(x, y, c) = 0.6f;
        }
    }
    const Plane<float> map = ldrFlipMap(pairOf(edge, greyImage(48, 48, 0.3f)), 1.0);
    // The bright side near the edge, beyond the colour filters' blur, against far from it.
    EXPECT_GT(map.row(24)[28], 1.1f * map.row(24)[44]);
    EXPECT_EQ(map.row(24)[2], 0.0f);
}

TEST(Flip, ShowsTheSamePictureForAnyUnitOfTheWhite) {
    const Image a = randomImage(32, 32, 1, 0.0f, 2.0f);
    const Image b = randomImage(32, 32, 2, 0.0f, 2.0f);
    EXPECT_EQ(ldrFlipMap(pairOf(a, b), 1.0).values,
              ldrFlipMap(pairOf(scaled(a, 256.0f), scaled(b, 256.0f)), 256.0).values);
}

TEST(Flip, CutsOffWhatIsBrighterThanTheWhiteAndBelowBlack) {
    EXPECT_EQ(meanFlip(greyImage(8, 8, 50.0f), greyImage(8, 8, 1.0f)), 0.0);
    EXPECT_EQ(meanFlip(greyImage(8, 8, -3.0f), greyImage(8, 8, 0.0f)), 0.0);
}

TEST(Flip, WorksForAnImageOfOnePixelAndAtTheEndsOfTheResolution) {
    for (const double ppd : {1.0, 67.0, 1000.0}) {
        EXPECT_NEAR(meanFlip(greyImage(1, 1, 0.0f), greyImage(1, 1, 1.0f), ppd), 0.9674, 5e-5);
    }
}

TEST(Flip, IsPooledOverCountedPixelsOnly) {
    const Image image = greyImage(2, 1, 1.0f);
    Image mask(2, 1, 1);
    mask.values = {1.0f, 0.0f};
    const ImagePair pair({.image = image, .reference = image, .mask = &mask});
    Plane<float> map(2, 1);
    map.values = {0.25f, 1.0f};
    EXPECT_EQ(pooledMean(pair, map), 0.25);
    EXPECT_EQ(pooledMean(pairOf(image, image), map), 0.625);
}

}  // namespace
}  // namespace kaustik::measure::test
