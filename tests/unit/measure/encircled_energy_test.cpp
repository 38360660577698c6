// SPDX-License-Identifier: MIT
#include "framework/measure/encircled_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

// A grey image of irradiance(x, y), each pixel the mean over 8x8 points.
Image spot(int width, int height, const std::function<double(double, double)>& irradiance) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double sum = 0.0;
            for (int j = 0; j < 8; ++j) {
                for (int i = 0; i < 8; ++i)
                    sum += irradiance(x + (i + 0.5) / 8.0, y + (j + 0.5) / 8.0) / 64.0;
            }
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(sum);
        }
    }
    return image;
}

Image disc(double x0, double y0, double radius) {
    return spot(120, 100, [=](double x, double y) {
        return std::hypot(x - x0, y - y0) < radius ? 1.0 : 0.0;
    });
}

Image gaussianSpot(double x0, double y0, double sigma) {
    return spot(120, 100, [=](double x, double y) {
        return std::exp(-0.5 * std::pow(std::hypot(x - x0, y - y0) / sigma, 2.0));
    });
}

EncircledEnergy measured(const Image& image, const EncircledEnergyParams& params = {}) {
    const ImagePair pair = pairOf(image, image);
    const auto energy = encircledEnergy(pair, pair.image(), params);
    EXPECT_TRUE(energy);
    return energy.value_or(EncircledEnergy{});
}

// The light of a pixel is evened out over its square, here and when the image was made: that widens
// a Gaussian's variance by 1/6 px², and the radii below by up to 0.034 px.
constexpr double kTolerancePixels = 0.05;

TEST(EncircledEnergy, OfAnEvenDiscIsHalvedByTheCircleOfHalfItsArea) {
    const EncircledEnergy energy = measured(disc(61.3, 48.9, 20.0));
    EXPECT_NEAR(energy.centreX, 61.3, 0.01);
    EXPECT_NEAR(energy.centreY, 48.9, 0.01);
    EXPECT_NEAR(energy.radiusPixels, 20.0 / std::numbers::sqrt2, kTolerancePixels);
}

TEST(EncircledEnergy, OfAGaussianFollowsItsClosedFormForAnyShare) {
    for (const double share : {0.1, 0.5, 0.8, 0.95}) {
        EncircledEnergyParams params;
        params.share = share;
        const double expected = 6.0 * std::sqrt(-2.0 * std::log(1.0 - share));
        EXPECT_NEAR(measured(gaussianSpot(60.0, 50.0, 6.0), params).radiusPixels, expected,
                    kTolerancePixels)
            << share;
    }
}

TEST(EncircledEnergy, OfASinglePixelIsTheCircleOfHalfItsArea) {
    Image image = greyImage(9, 9, 0.0f);
    image.at(4, 4, 1) = 7.0f;
    EXPECT_NEAR(measured(image).radiusPixels, std::sqrt(0.5 / std::numbers::pi), 0.01);
}

TEST(EncircledEnergy, GrowsWithBlurButNotWithDisplacementOrBrightness) {
    const Image reference = gaussianSpot(40.0, 40.0, 3.0);
    const auto ratio = [&](const Image& image) {
        return compareEncircledEnergy(pairOf(image, reference), {})->radiusRatio;
    };
    EXPECT_EQ(ratio(reference), 1.0);
    EXPECT_NEAR(ratio(gaussianSpot(40.0, 40.0, 6.0)), 2.0, 0.03);
    EXPECT_NEAR(ratio(gaussianSpot(71.4, 52.2, 3.0)), 1.0, 0.02);
    EXPECT_NEAR(ratio(scaled(reference, 8.0f)), 1.0, 1e-12);
}

TEST(EncircledEnergy, MayBeAroundTheBrightestPointInstead) {
    Image image = disc(60.0, 50.0, 20.0);
    for (int c = 0; c < 3; ++c)
        image.at(30, 20, c) = 3.0f;
    EncircledEnergyParams params;
    params.centre = EnergyCentre::brightest;
    const EncircledEnergy energy = measured(image, params);
    EXPECT_EQ(energy.centreX, 30.5);
    EXPECT_EQ(energy.centreY, 20.5);
    EXPECT_GT(energy.radiusPixels, 30.0);
    EXPECT_NEAR(measured(image).centreX, 60.0, 0.1);
}

TEST(EncircledEnergy, IsInMetresWhereTheSizeOfAPixelIsKnown) {
    const Image image = disc(60.0, 50.0, 20.0);
    EncircledEnergyParams params;
    EXPECT_FALSE(compareEncircledEnergy(pairOf(image, image), params)->imageRadiusMeters);
    params.metersPerPixel = 0.005;
    const auto given = compareEncircledEnergy(pairOf(image, image), params);
    EXPECT_DOUBLE_EQ(given->imageRadiusMeters.value(), 0.005 * given->image.radiusPixels);

    Image area(120, 100, 1);
    std::fill(area.values.begin(), area.values.end(), 0.0004f);
    const ImagePair pair({.image = image, .reference = image, .area = &area});
    const auto fromArea = compareEncircledEnergy(pair, {});
    // The area is a float.
    EXPECT_NEAR(fromArea->referenceRadiusMeters.value(), 0.02 * fromArea->reference.radiusPixels,
                1e-7);
}

TEST(EncircledEnergy, DoesNotExistWithoutLight) {
    const Image black = greyImage(5, 5, 0.0f);
    const Image lit = greyImage(5, 5, 1.0f);
    EXPECT_FALSE(compareEncircledEnergy(pairOf(black, lit), {}));
    EXPECT_FALSE(compareEncircledEnergy(pairOf(lit, black), {}));
    EXPECT_FALSE(compareEncircledEnergy(pairOf(greyImage(5, 5, -1.0f), lit), {}));
}

}  // namespace
}  // namespace kaustik::measure::test
