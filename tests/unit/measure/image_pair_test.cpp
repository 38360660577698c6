// SPDX-License-Identifier: MIT
// What may be compared, and what is refused before any number is made.
#include "framework/measure/image_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/core/error.h"
#include "framework/measure/finite.h"
#include "tests/unit/measure/test_images.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::measure::test {
namespace {

using kaustik::test::messageOf;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(NotFinite, IsNothingForAnImageOfNumbersHoweverLarge) {
    EXPECT_FALSE(findNotFinite(greyImage(3, 2, std::numeric_limits<float>::max())));
}

TEST(NotFinite, CountsEachKindAndNamesTheFirstPixelInReadingOrder) {
    Image image = greyImage(5, 4, 1.0f);
    image.at(4, 3, 0) = kNan;
    image.at(0, 2, 1) = -kInfinity;
    image.at(1, 2, 0) = kNan;
    const auto found = findNotFinite(image);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->nanCount, 2u);
    EXPECT_EQ(found->infinityCount, 1u);
    EXPECT_EQ(found->x, 0);
    EXPECT_EQ(found->y, 2);
    EXPECT_EQ(found->channel, 1);
    EXPECT_EQ(describe(*found),
              "3 values that are not finite (2 NaN, 1 infinite), the first at pixel (0, 2), "
              "channel 1");
}

TEST(ImagePair, WithNanOrInfinityInEitherImageIsAnErrorThatNamesItAndThePixel) {
    const Image good = greyImage(8, 8, 0.5f);
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        Image broken = good;
        broken.at(3, 5, 2) = bad;
        EXPECT_THAT(messageOf<IoError>([&] {
                        (void)ImagePair({.image = broken, .reference = good, .imageName = "a.exr"});
                    }),
                    AllOf(HasSubstr("a.exr has 1 value"), HasSubstr("pixel (3, 5), channel 2")));
        EXPECT_THAT(
            messageOf<IoError>([&] {
                (void)ImagePair({.image = good, .reference = broken, .referenceName = "b.exr"});
            }),
            HasSubstr("b.exr has 1 value"));
    }
}

TEST(ImagePair, NanIsAnErrorAlsoWhereTheMaskLeavesThePixelOutAndInTheAlphaChannel) {
    const Image good = greyImage(2, 1, 0.5f);
    Image broken = good;
    broken.at(0, 0, 0) = kNan;
    Image mask(2, 1, 1);
    mask.values = {0.0f, 1.0f};
    EXPECT_THROW((void)ImagePair({.image = broken, .reference = good, .mask = &mask}), IoError);
    Image rgba(2, 1, 4);
    rgba.at(1, 0, 3) = kNan;
    EXPECT_THROW((void)ImagePair({.image = rgba, .reference = good}), IoError);
}

TEST(ImagePair, OfTwoSizesIsAnErrorThatSaysBoth) {
    const std::string message =
        messageOf<ConfigError>([] { (void)pairOf(greyImage(4, 3, 0.0f), greyImage(3, 4, 0.0f)); });
    EXPECT_THAT(message, AllOf(HasSubstr("4x3"), HasSubstr("3x4"), HasSubstr("same size")));
}

TEST(ImagePair, WithChannelsThatMeanDifferentThingsIsAnError) {
    EXPECT_THAT(messageOf<ConfigError>([] { (void)pairOf(Image(2, 2, 2), Image(2, 2, 2)); }),
                HasSubstr("2 channels"));
    EXPECT_THAT(messageOf<ConfigError>([] { (void)pairOf(Image(2, 2, 1), Image(2, 2, 3)); }),
                HasSubstr("do not show the same quantity"));
    EXPECT_THROW((void)pairOf(Image(), Image()), ConfigError);
}

TEST(ImagePair, ReadsGreyAsThreeEqualChannelsAndLeavesAlphaOut) {
    Image grey(1, 1, 1);
    grey.values = {0.25f};
    EXPECT_EQ(pairOf(grey, grey).image().values, (std::vector<float>{0.25f, 0.25f, 0.25f}));
    Image rgba(1, 1, 4);
    rgba.values = {1.0f, 2.0f, 3.0f, 0.5f};
    EXPECT_EQ(pairOf(rgba, rgba).reference().values, (std::vector<float>{1.0f, 2.0f, 3.0f}));
}

TEST(ImagePair, LeavesOutThePixelsWhereTheMaskIsZero) {
    const Image image = randomImage(3, 1, 1);
    const Image reference = randomImage(3, 1, 2);
    Image mask(3, 1, 1);
    mask.values = {1.0f, 0.0f, 0.25f};
    const ImagePair pair({.image = image, .reference = reference, .mask = &mask});
    EXPECT_EQ(pair.countedPixels(), 2u);
    EXPECT_TRUE(pair.counts(0));
    EXPECT_FALSE(pair.counts(1));
    EXPECT_EQ(pair.image().at(1, 0, 2), 0.0f);
    EXPECT_EQ(pair.area(1), 0.0);
    EXPECT_EQ(pair.image().at(2, 0, 1), image.at(2, 0, 1));
}

TEST(ImagePair, WithAMaskThatLeavesNothingIsAnError) {
    const Image image = greyImage(2, 2, 1.0f);
    const Image mask(2, 2, 1);
    EXPECT_THAT(messageOf<ConfigError>(
                    [&] { (void)ImagePair({.image = image, .reference = image, .mask = &mask}); }),
                HasSubstr("nothing to compare"));
}

TEST(ImagePair, WithANegativeStandardErrorOrAreaIsAnErrorThatNamesThePixel) {
    const Image image = greyImage(2, 2, 1.0f);
    Image negative = image;
    negative.at(1, 1, 0) = -0.5f;
    EXPECT_THAT(
        messageOf<IoError>([&] {
            (void)ImagePair({.image = image, .reference = image, .standardError = &negative});
        }),
        HasSubstr("negative (-0.5) at pixel (1, 1)"));
    EXPECT_THROW((void)ImagePair({.image = image, .reference = image, .area = &negative}), IoError);
    const Image small = greyImage(1, 1, 1.0f);
    EXPECT_THROW((void)ImagePair({.image = image, .reference = image, .standardError = &small}),
                 ConfigError);
    EXPECT_THROW((void)ImagePair({.image = image, .reference = image, .area = &small}),
                 ConfigError);
}

}  // namespace
}  // namespace kaustik::measure::test
