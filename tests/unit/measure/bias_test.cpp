// SPDX-License-Identifier: MIT
#include "framework/measure/bias.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/measure/test_images.h"

namespace kaustik::measure {
namespace {

Image filled(float value) {
    Image image(100, 80, 3);
    std::fill(image.values.begin(), image.values.end(), value);
    return image;
}

TEST(Bias, OfTheTruthIsWhatChanceHasOfIt) {
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0.0f, 0.1f);
    Image reference = filled(0.0f);
    for (std::size_t i = 0; i < reference.values.size(); i += 3) {
        const float value = 2.0f + noise(random);
        std::fill_n(reference.values.begin() + static_cast<std::ptrdiff_t>(i), 3, value);
    }
    const Image image = filled(2.0f);
    const Image sigma = filled(0.1f);
    const ImagePair pair({.image = image, .reference = reference, .standardError = &sigma});
    const Bias bias = findBias(pair);
    EXPECT_EQ(bias.judgedPixels, 8000u);
    // 8 pixels are expected; 20 have a probability of 2e-4.
    EXPECT_LT(bias.tooBright + bias.tooDark, 20.0 / 8000.0);
    EXPECT_GT(bias.tooBright + bias.tooDark, 0.0);
}

TEST(Bias, IsToldFromNoiseByItsSignAndSize) {
    const Image reference = filled(2.0f);
    Image sigma = filled(0.1f);
    Image image = filled(2.0f);
    const auto set = [&](int x, float value) {
        for (int c = 0; c < 3; ++c)
            image.at(x, 10, c) = value;
    };
    set(0, 2.32f);  // within
    set(1, 2.34f);
    set(2, 1.66f);
    set(3, 9.0f);
    set(4, 9.0f);
    for (int c = 0; c < 3; ++c)
        sigma.at(4, 10, c) = 0.0f;  // no photon of the reference came here
    const ImagePair pair({.image = image, .reference = reference, .standardError = &sigma});
    const Bias bias = findBias(pair);
    EXPECT_EQ(bias.judgedPixels, 8000u);
    EXPECT_DOUBLE_EQ(bias.tooBright, 3.0 / 8000.0);
    EXPECT_DOUBLE_EQ(bias.tooDark, 1.0 / 8000.0);

    const Image picture = biasPicture(pair);
    const auto at = [&](int x, int c) { return picture.at(x, 10, c); };
    EXPECT_LT(at(0, 0), 0.1f);
    EXPECT_GT(at(1, 0), at(1, 2)) << "too bright is orange";
    EXPECT_LT(at(2, 0), at(2, 2)) << "too dark is blue";
    EXPECT_GT(at(3, 0), at(1, 0)) << "more is brighter";
    EXPECT_FLOAT_EQ(at(4, 0), at(3, 0)) << "by the others' noise";
}

TEST(Bias, OfAReferenceWithoutNoiseIsNotJudged) {
    const Image image = filled(3.0f);
    const Image none = filled(0.0f);
    const ImagePair pair({.image = image, .reference = none, .standardError = &none});
    EXPECT_EQ(findBias(pair).judgedPixels, 0u);
    EXPECT_EQ(findBias(pair).tooBright, 0.0);
}

TEST(Bias, LeavesOutWhatTheMaskDoes) {
    const Image image = filled(3.0f);
    const Image reference = filled(2.0f);
    const Image sigma = filled(0.1f);
    Image mask(100, 80, 1);
    mask.at(5, 5, 0) = 1.0f;
    const ImagePair pair(
        {.image = image, .reference = reference, .mask = &mask, .standardError = &sigma});
    EXPECT_EQ(findBias(pair).judgedPixels, 1u);
    EXPECT_EQ(findBias(pair).tooBright, 1.0);
    EXPECT_FLOAT_EQ(biasPicture(pair).at(6, 5, 1), 0.5f);
}

}  // namespace
}  // namespace kaustik::measure
