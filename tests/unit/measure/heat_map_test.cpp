// SPDX-License-Identifier: MIT
#include "framework/measure/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

// CIE L* of a display colour.
double lightness(const std::array<float, 3>& color) {
    const auto linear = [](float encoded) {
        const double value = static_cast<double>(encoded);
        return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    };
    const double y =
        0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : 24389.0 / 27.0 * y;
}

TEST(HeatColor, RisesEvenlyInLightnessFromNearlyBlackToNearlyWhite) {
    EXPECT_LT(lightness(heatColor(0.0)), 5.0);
    EXPECT_GT(lightness(heatColor(1.0)), 90.0);
    const double step = (lightness(heatColor(1.0)) - lightness(heatColor(0.0))) / 16.0;
    for (int i = 0; i < 16; ++i) {
        const double rise = lightness(heatColor((i + 1) / 16.0)) - lightness(heatColor(i / 16.0));
        // The map has 256 colours, 16 a step: half a colour at each end.
        EXPECT_NEAR(rise / step, 1.0, 1.0 / 16.0 + 0.01) << i;
    }
}

TEST(HeatColor, CanBeShownAndIsColorfulInTheMiddle) {
    for (int i = 0; i <= 255; ++i) {
        for (const float value : heatColor(i / 255.0)) {
            EXPECT_GE(value, 0.0f);
            EXPECT_LE(value, 1.0f);
        }
    }
    const auto middle = heatColor(0.5);
    EXPECT_GT(middle[0], middle[1] + 0.3f);
}

TEST(HeatColor, StaysAtItsEndsOutsideTheScale) {
    EXPECT_EQ(heatColor(-3.0), heatColor(0.0));
    EXPECT_EQ(heatColor(7.0), heatColor(1.0));
    EXPECT_EQ(heatColor(std::numeric_limits<double>::infinity()), heatColor(1.0));
    EXPECT_EQ(heatColor(std::numeric_limits<double>::quiet_NaN()), heatColor(0.0));
}

TEST(HeatMap, ShowsErrorsOnItsScaleAndPixelsThatAreLeftOutInGrey) {
    const Image reference = greyImage(3, 1, 1.0f);
    Image image = reference;
    image.at(0, 0, 0) = 2.5f;  // mean over the channels: 0.5
    Image mask(3, 1, 1);
    mask.values = {1.0f, 1.0f, 0.0f};
    const ImagePair pair({.image = image, .reference = reference, .mask = &mask});
    const Plane<float> errors = absoluteErrorPlane(pair);
    EXPECT_EQ(errors.values, (std::vector<float>{0.5f, 0.0f, 0.0f}));
    const Image map = heatMap(pair, errors, 2.0);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(map.at(0, 0, c), heatColor(0.25)[static_cast<std::size_t>(c)]);
        EXPECT_EQ(map.at(1, 0, c), heatColor(0.0)[static_cast<std::size_t>(c)]);
        EXPECT_EQ(map.at(2, 0, c), 0.5f);
    }
}

}  // namespace
}  // namespace kaustik::measure::test
