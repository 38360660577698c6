// SPDX-License-Identifier: MIT
#include "framework/measure/reference_scale.h"

#include <gtest/gtest.h>

#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

// Grey pixels of the given values, the rest of the image black.
Image litPixels(const std::vector<float>& values, int width, int height) {
    Image image(width, height, 3);
    for (std::size_t pixel = 0; pixel < values.size(); ++pixel) {
        for (std::size_t c = 0; c < 3; ++c)
            image.values[3 * pixel + c] = values[pixel];
    }
    return image;
}

TEST(ReferenceScale, HasTheLuminancesThatHoldATenthAHalfAndNineTenthsOfTheFlux) {
    // Flux from the brightest on: 8 of 20 (40 %), 14 (70 %), 17 (85 %), 19 (95 %), 20.
    const Image reference = litPixels({1.0f, 8.0f, 3.0f, 2.0f, 6.0f}, 5, 1);
    const ReferenceScale scale = referenceScale(pairOf(reference, reference));
    // Luminance of (v, v, v) is v to within the rounding of the coefficients' sum.
    EXPECT_NEAR(scale.brightest, 8.0, 1e-8);
    EXPECT_NEAR(scale.white, 8.0, 1e-8);
    EXPECT_NEAR(scale.typical, 6.0, 1e-8);
    EXPECT_NEAR(scale.faint, 2.0, 1e-8);
}

TEST(ReferenceScale, DoesNotChangeWithTheAmountOfBlackAround) {
    const std::vector<float> values{1.0f, 8.0f, 3.0f, 2.0f, 6.0f};
    const Image small = litPixels(values, 5, 1);
    const Image large = litPixels(values, 100, 100);
    EXPECT_EQ(referenceScale(pairOf(large, large)).typical,
              referenceScale(pairOf(small, small)).typical);
    EXPECT_EQ(referenceScale(pairOf(large, large)).faint,
              referenceScale(pairOf(small, small)).faint);
}

TEST(ReferenceScale, WeighsWithTheAreaOfThePixels) {
    const Image reference = litPixels({8.0f, 1.0f}, 2, 1);
    Image area(2, 1, 1);
    area.values = {1.0f, 100.0f};
    const ImagePair pair({.image = reference, .reference = reference, .area = &area});
    EXPECT_NEAR(referenceScale(pair).brightest, 8.0, 1e-8);
    EXPECT_NEAR(referenceScale(pair).white, 1.0, 1e-8);
}

TEST(ReferenceScale, OfABlackReferenceIsBlackWhateverTheImageIs) {
    const ImagePair pair = pairOf(greyImage(3, 3, 5.0f), greyImage(3, 3, 0.0f));
    EXPECT_TRUE(referenceScale(pair).isBlack());
}

}  // namespace
}  // namespace kaustik::measure::test
