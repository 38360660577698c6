// SPDX-License-Identifier: MIT
#include "framework/image/pfm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "framework/core/error.h"
#include "tests/unit/peak_memory.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik {
namespace {

using namespace std::string_literals;
using test::messageOf;
using ::testing::HasSubstr;

// 1.0f is 0x3f800000, 2.0f is 0x40000000, -0.5f is 0xbf000000 (IEEE 754).
const std::string kOneLittle = "\x00\x00\x80\x3f"s;
const std::string kTwoLittle = "\x00\x00\x00\x40"s;
const std::string kMinusHalfLittle = "\x00\x00\x00\xbf"s;
const std::string kOneBig = "\x3f\x80\x00\x00"s;
const std::string kTwoBig = "\x40\x00\x00\x00"s;

TEST(Pfm, RowsInTheFileGoFromTheBottomToTheTop) {
    const Image image = decodePfm("Pf\n1 2\n-1.0\n" + kOneLittle + kTwoLittle, "a.pfm");
    EXPECT_EQ(image.at(0, 1, 0), 1.0f);
    EXPECT_EQ(image.at(0, 0, 0), 2.0f);
}

TEST(Pfm, APositiveScaleMeansBigEndianValues) {
    const Image image = decodePfm("Pf\n2 1\n1.0\n" + kOneBig + kTwoBig, "a.pfm");
    EXPECT_EQ(image.at(0, 0, 0), 1.0f);
    EXPECT_EQ(image.at(1, 0, 0), 2.0f);
}

TEST(Pfm, TheScaleMultipliesTheValues) {
    EXPECT_EQ(decodePfm("Pf\n1 1\n-4\n" + kTwoLittle, "a.pfm").at(0, 0, 0), 8.0f);
}

TEST(Pfm, AFirstPixelThatLooksLikeWhiteSpaceIsAPixel) {
    // Exactly one white-space character ends the header: the first byte of the pixels is a blank.
    const Image image = decodePfm("Pf\n1 1\n-1.0\n\x20\x00\x80\x3f"s, "a.pfm");
    EXPECT_FLOAT_EQ(image.at(0, 0, 0), 1.0000038f);  // 1 + 32 units in the last place
}

TEST(Pfm, IsWrittenAsLittleEndianWithThreeInterleavedChannels) {
    Image image(1, 1, 3);
    image.values = {1.0f, 2.0f, -0.5f};
    EXPECT_EQ(encodePfm(image), "PF\n1 1\n-1.0\n" + kOneLittle + kTwoLittle + kMinusHalfLittle);
}

// A mebibyte is what reading a small file may take; an image of that size takes 2047.
constexpr std::size_t kNegligible = std::size_t{1} << 20;

TEST(Pfm, AHeaderAloneTakesNoMemoryForThePixelsThatItClaims) {
    const std::size_t before = test::peakBytes();
    EXPECT_THAT(messageOf<IoError>([] { (void)decodePfm("PF\n16384 10922\n-1.0\n", "a.pfm"); }),
                HasSubstr("a.pfm is not a whole PFM file: it is cut off"));
    EXPECT_LT(test::peakBytes() - before, kNegligible);
}

TEST(Ppm, AHeaderAloneTakesNoMemoryForThePixelsThatItClaims) {
    const std::size_t before = test::peakBytes();
    EXPECT_THAT(messageOf<IoError>([] { (void)decodePpm("P6\n16384 10922\n255\n", "a.ppm"); }),
                HasSubstr("a.ppm is not a whole PPM file: it is cut off"));
    EXPECT_LT(test::peakBytes() - before, kNegligible);
}

TEST(Pfm, AFileCutOffAtAnyByteIsAnErrorThatNamesIt) {
    const std::string whole = "PF\n2 1\n-1.0\n" + kOneLittle + kTwoLittle + kMinusHalfLittle +
                              kOneLittle + kTwoLittle + kMinusHalfLittle;
    ASSERT_NO_THROW((void)decodePfm(whole, "cut.pfm"));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::string message = messageOf<IoError>(
            [&] { (void)decodePfm(std::string_view(whole).substr(0, length), "cut.pfm"); });
        EXPECT_THAT(message, HasSubstr("cut.pfm")) << "cut after byte " << length;
    }
}

TEST(Pfm, SaysHowManyBytesAreMissingOrTooMany) {
    const auto read = [](const std::string& bytes) {
        return messageOf<IoError>([&] { (void)decodePfm(bytes, "a.pfm"); });
    };
    EXPECT_THAT(read("Pf\n2 1\n-1.0\n" + kOneLittle), HasSubstr("4 bytes of pixels of 8"));
    EXPECT_THAT(read("Pf\n1 1\n-1.0\n" + kOneLittle + "xyz"), HasSubstr("3 bytes follow"));
}

TEST(Pfm, AHeaderThatMakesNoSenseIsAnError) {
    const auto read = [](const std::string& header) {
        return messageOf<IoError>([&] { (void)decodePfm(header + kOneLittle, "a.pfm"); });
    };
    EXPECT_THAT(read("PG\n1 1\n-1.0\n"), HasSubstr("does not begin with PF"));
    EXPECT_THAT(read("Pf\none 1\n-1.0\n"), HasSubstr("width"));
    EXPECT_THAT(read("Pf\n1 1x\n-1.0\n"), HasSubstr("height"));
    EXPECT_THAT(read("Pf\n0 1\n-1.0\n"), HasSubstr("no pixels (0x1)"));
    EXPECT_THAT(read("Pf\n1 -1\n-1.0\n"), HasSubstr("no pixels (1x-1)"));
    EXPECT_THAT(read("Pf\n1 1\n0\n"), HasSubstr("scale"));
    EXPECT_THAT(read("Pf\n1 1\nnan\n"), HasSubstr("scale"));
    EXPECT_THAT(read("Pf\n1 1\ninf\n"), HasSubstr("scale"));
}

TEST(Pfm, AHeaderThatAsksForMoreThanTheLimitIsAnErrorBeforeMemoryIsTaken) {
    const auto read = [](const std::string& size) {
        return messageOf<IoError>([&] { (void)decodePfm("PF\n" + size + "\n-1.0\n", "a.pfm"); });
    };
    EXPECT_THAT(read("65537 1"), HasSubstr("too large"));
    EXPECT_THAT(read("60000 60000"), HasSubstr("too large"));
    EXPECT_THAT(read("9223372036854775807 9223372036854775807"), HasSubstr("too large"));
    EXPECT_THAT(read("99999999999999999999 1"), HasSubstr("width"));
}

TEST(Ppm, ValuesAreDividedByTheMaximum) {
    const Image image = decodePpm("P6 1 1 100\n\x64\x32\x00"s, "a.ppm");
    EXPECT_EQ(image.at(0, 0, 0), 1.0f);
    EXPECT_EQ(image.at(0, 0, 1), 0.5f);
    EXPECT_EQ(image.at(0, 0, 2), 0.0f);
}

TEST(Ppm, AMaximumAbove255MeansTwoBytesMostSignificantFirst) {
    const Image image = decodePpm("P6\n# made by hand\n1 1\n65535\n\xff\xff\x00\x01\x01\x00"s, "a");
    EXPECT_EQ(image.at(0, 0, 0), 1.0f);
    EXPECT_FLOAT_EQ(image.at(0, 0, 1), 1.0f / 65535.0f);
    EXPECT_FLOAT_EQ(image.at(0, 0, 2), 256.0f / 65535.0f);
}

TEST(Ppm, AValueAboveTheMaximumIsAnError) {
    EXPECT_THAT(messageOf<IoError>([] { (void)decodePpm("P6 1 1 9\n\x01\x0a\x01"s, "a.ppm"); }),
                HasSubstr("above its maximum"));
}

TEST(Ppm, AFileCutOffAtAnyByteIsAnErrorThatNamesIt) {
    const std::string whole = "P6\n2 1\n255\n\x01\x02\x03\x04\x05\x06"s;
    ASSERT_NO_THROW((void)decodePpm(whole, "cut.ppm"));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::string message = messageOf<IoError>(
            [&] { (void)decodePpm(std::string_view(whole).substr(0, length), "cut.ppm"); });
        EXPECT_THAT(message, HasSubstr("cut.ppm")) << "cut after byte " << length;
    }
}

TEST(Ppm, IsWrittenWithEightBitsAndGreyInAllThreeChannels) {
    Image grey(2, 1, 1);
    grey.values = {0.0f, 1.0f};
    EXPECT_EQ(encodePpm(grey), "P6\n2 1\n255\n\x00\x00\x00\xff\xff\xff"s);
    Image colour(1, 1, 3);
    colour.values = {0.0f, 0.5f, 1.0f};
    EXPECT_EQ(encodePpm(colour), "P6\n1 1\n255\n\x00\x80\xff"s);
}

}  // namespace
}  // namespace kaustik
