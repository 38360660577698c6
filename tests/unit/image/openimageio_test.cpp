// SPDX-License-Identifier: MIT
// Images through the OpenImageIO module. The PNG and JPEG bytes were made by other programs
// (Python's zlib and struct modules, and libjpeg), so that no file is judged by the code that wrote
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/image.h"
#include "framework/image/module_images.h"
#include "framework/image/module_loader.h"
#include "tests/unit/peak_memory.h"
#include "tests/unit/temporary_folder.h"

// LeakSanitizer, where the tests are built with it, sees by which way memory was had only when the
// stack is walked the slow way.
extern "C" const char* __asan_default_options() {
    return "fast_unwind_on_malloc=0";
}
// OpenImageIO 2.4 loses the message of a PNG that cannot be opened: 31 bytes, not ours to free.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:OpenImageIO_v2_4::ImageInput::geterror";
}

namespace kaustik {
namespace {

using test::messageOf;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string fromHex(std::string_view digits) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
        bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
    }
    return bytes;
}

// 2x2 RGBA: red, half transparent green / wholly transparent blue, (51, 102, 153) with alpha 51.
const std::string kPng = fromHex(
    "89504e470d0a1a0a0000000d494844520000000200000002080600000072b60d24000000164944415478da63f8"
    "cfc0f01f081b1840b471da4c6300394405e25640e6570000000049454e44ae426082");

// The same, but the header claims 100,000 x 100,000 pixels.
const std::string kHugePng = fromHex(
    "89504e470d0a1a0a0000000d49484452000186a0000186a00806000000a8520bc8000000164944415478da63f8"
    "cfc0f01f081b1840b471da4c6300394405e25640e6570000000049454e44ae426082");

// 16384x10000 RGB, which is allowed, in 69 bytes, which is not.
const std::string kHollowPng = fromHex(
    "89504e470d0a1a0a0000000d49484452000040000000271008020000006b6df7230000000c49444154789c6360"
    "a03d00000064000186643c350000000049454e44ae426082");

// 8x8 grey: the left half black, the right half white.
const std::string kJpeg = fromHex(
    "ffd8ffe000104a46494600010100000100010000ffe1001645786966000049492a0008000000000000000000ff"
    "db0043000302020302020303030304030304050805050404050a070706080c0a0c0c0b0a0b0b0d0e12100d0e11"
    "0e0b0b1016101113141515150c0f171816141812141514ffc0000b080008000801011100ffc4001f0000010501"
    "010101010100000000000000000102030405060708090a0bffc400b51000020103030204030505040400000"
    "17d01020300041105122131410613516107227114328191a1082342b1c11552d1f02433627282090a161718191"
    "a25262728292a3435363738393a434445464748494a535455565758595a636465666768696a737475767778797"
    "a838485868788898a92939495969798999aa2a3a4a5a6a7a8a9aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad"
    "2d3d4d5d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4f5f6f7f8f9faffda0008010100003f004ff8218ffcd6c"
    "ffb827fedfd7fffd9");

class OpenImageIo : public ::testing::Test {
  protected:
    void SetUp() override {
        const ImageModule module = loadImageModule(helperFolder() / "kaustik_openimageio.so");
        if (module.functions == nullptr) GTEST_SKIP() << module.problem;
    }
    TemporaryFolder folder_;
};

TEST_F(OpenImageIo, AnExrKeepsEveryFloatBitForBit) {
    Image image(3, 2, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = std::ldexp(1.0f + 0x1p-23f, 20 * static_cast<int>(i) - 126);
    }
    image.at(2, 1, 2) = std::numeric_limits<float>::infinity();
    image.at(1, 1, 0) = -0.1f;
    for (const int channels : {1, 2, 3, 4}) {
        Image part(3, 2, channels);
        std::copy_n(image.values.begin(), std::min(image.values.size(), part.values.size()),
                    part.values.begin());
        writeImage(folder_ / "a.exr", part);
        const Image back = readImage(folder_ / "a.exr");
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.values, part.values) << channels;
    }
}

TEST_F(OpenImageIo, AnExrKeepsNotANumber) {
    Image image(1, 1, 1);
    image.values[0] = std::numeric_limits<float>::quiet_NaN();
    writeImage(folder_ / "a.exr", image);
    EXPECT_TRUE(std::isnan(readImage(folder_ / "a.exr").values[0]));
}

TEST_F(OpenImageIo, APngHoldsEightBitsWithTheFirstRowOnTop) {
    Image image(1, 2, 3);
    image.values = {1.0f, 0.5f, 0.0f, 2.0f, -1.0f, 0.25f};
    writeImage(folder_ / "a.png", image);
    const Image back = readImage(folder_ / "a.png");
    const std::vector<float> expected{1.0f, 128.0f / 255.0f, 0.0f, 1.0f, 0.0f, 64.0f / 255.0f};
    ASSERT_EQ(back.values.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_FLOAT_EQ(back.values[i], expected[i]) << i;
    }
}

TEST_F(OpenImageIo, ColoursAreNotMultipliedByAlpha) {
    const Image image = decodeImage(kPng, "texture");
    ASSERT_EQ(image.channels, 4);
    EXPECT_FLOAT_EQ(image.at(1, 0, 1), 1.0f);
    EXPECT_FLOAT_EQ(image.at(1, 0, 3), 128.0f / 255.0f);
    EXPECT_FLOAT_EQ(image.at(0, 1, 2), 1.0f);
    EXPECT_FLOAT_EQ(image.at(0, 1, 3), 0.0f);
    EXPECT_FLOAT_EQ(image.at(1, 1, 0), 51.0f / 255.0f);
    writeImage(folder_ / "a.png", image);
    EXPECT_EQ(readImage(folder_ / "a.png").values, image.values);
}

TEST_F(OpenImageIo, AJpegInMemoryIsDecoded) {
    const Image image = decodeImage(kJpeg, "texture");
    ASSERT_EQ(image.width, 8);
    ASSERT_EQ(image.height, 8);
    // Quality 90 moves the values next to the edge by a few hundredths.
    EXPECT_NEAR(image.at(0, 0, 0), 0.0f, 0.05f);
    EXPECT_NEAR(image.at(7, 7, image.channels - 1), 1.0f, 0.05f);
}

// A file without its last bytes is an error or, where only a trailer is missing, the whole image.
void expectWholeOrError(const std::string& bytes) {
    const Image whole = decodeImage(bytes, "cut");
    std::size_t errors = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        // A copy of exactly that length, so that AddressSanitizer sees a read past its end.
        const std::vector<char> cut(bytes.begin(),
                                    bytes.begin() + static_cast<std::ptrdiff_t>(length));
        try {
            const Image image = decodeByModule(std::string_view(cut.data(), cut.size()), "cut");
            EXPECT_EQ(image.values, whole.values) << "cut after byte " << length;
        } catch (const IoError& error) {
            EXPECT_THAT(error.what(), HasSubstr("cut cannot be read")) << length;
            ++errors;
        }
    }
    // All but the trailer: 12 bytes of IEND and 4 of a checksum in a PNG, 2 in a JPEG.
    EXPECT_GE(errors, bytes.size() - 16);
}

TEST_F(OpenImageIo, APngCutOffAtAnyByteIsAnErrorOrWhole) {
    expectWholeOrError(kPng);
}

TEST_F(OpenImageIo, AJpegCutOffAtAnyByteIsAnErrorOrWhole) {
    expectWholeOrError(kJpeg);
}

TEST_F(OpenImageIo, AnExrFileCutOffAnywhereIsAnError) {
    writeImage(folder_ / "whole.exr", Image(16, 16, 3));
    std::ifstream stream(folder_ / "whole.exr", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    for (std::size_t length = 0; length < bytes.size(); length += 7) {
        const auto cut = folder_.file("cut.exr", std::string_view(bytes).substr(0, length));
        EXPECT_THAT(messageOf<IoError>([&] { (void)readImage(cut); }), HasSubstr("cut.exr"))
            << "cut after byte " << length;
    }
}

TEST_F(OpenImageIo, AHeaderThatClaimsTooManyPixelsIsAnErrorBeforeMemoryIsTaken) {
    EXPECT_THAT(messageOf<IoError>([] { (void)decodeImage(kHugePng, "huge"); }),
                HasSubstr("huge cannot be read"));
}

TEST_F(OpenImageIo, AHeaderThatClaimsMoreThanItsBytesCanHoldIsAnErrorBeforeMemoryIsTaken) {
    const std::size_t before = test::peakBytes();
    EXPECT_THAT(messageOf<IoError>([] { (void)decodeByModule(kHollowPng, "hollow"); }),
                AllOf(HasSubstr("hollow cannot be read"),
                      HasSubstr("69 bytes cannot hold the 16384x10000 pixels")));
    // OpenImageIO itself; the image would take 1875 MiB.
    EXPECT_LT(test::peakBytes() - before, std::size_t{100} << 20);
    const auto file = folder_.file("hollow.png", kHollowPng);
    EXPECT_THAT(messageOf<IoError>([&] { (void)readImage(file); }),
                HasSubstr("69 bytes cannot hold"));
}

TEST_F(OpenImageIo, BytesThatAreNoImageAreAnError) {
    for (const char* bytes : {"", "x", "hello, this is a text", "\x89PNG", "RIFF"}) {
        EXPECT_THAT(messageOf<IoError>([&] { (void)decodeImage(bytes, "text"); }),
                    HasSubstr("text cannot be read"))
            << bytes;
    }
    const auto text = folder_.file("text.png", "hello, this is a text");
    EXPECT_THAT(messageOf<IoError>([&] { (void)readImage(text); }),
                AllOf(HasSubstr("text.png"), HasSubstr("no image")));
}

}  // namespace
}  // namespace kaustik
