// SPDX-License-Identifier: MIT
// The module of OpenEXR and PNG alone next to OpenImageIO's: each reads what the other has written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "framework/core/files.h"
#include "framework/image/eight_bits.h"
#include "framework/image/image.h"
#include "framework/image/layered_image.h"
#include "framework/image/module_images.h"
#include "framework/image/module_loader.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

std::string fromHex(std::string_view digits) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
    return bytes;
}

// What a module hands over.
struct Received {
    Image image;
    std::vector<std::string> channels;
    std::string bytes;
    std::string problem;
};

KaustikImageSink sinkFor(Received& received) {
    KaustikImageSink sink{};
    sink.context = &received;
    sink.allocate = [](void* context, int width, int height, int channels) {
        auto& target = *static_cast<Received*>(context);
        target.image = Image(width, height, channels);
        return target.image.values.data();
    };
    sink.append = [](void* context, const unsigned char* bytes, std::size_t count) {
        static_cast<Received*>(context)->bytes.append(reinterpret_cast<const char*>(bytes), count);
        return true;
    };
    sink.fail = [](void* context, const char* message) {
        static_cast<Received*>(context)->problem = message;
    };
    sink.channel = [](void* context, const char* name) {
        static_cast<Received*>(context)->channels.emplace_back(name);
        return true;
    };
    sink.attribute = [](void*, const char*, const char*) { return true; };
    return sink;
}

class ExrPng : public ::testing::Test {
  protected:
    void SetUp() override {
        if (module().functions == nullptr) GTEST_SKIP() << module().problem;
    }
    static const ImageModule& module() {
        static const ImageModule loaded = loadImageModule(helperFolder() / "kaustik_exr_png.so");
        return loaded;
    }
    static Received decode(const std::string& bytes) {
        Received received;
        const KaustikImageSink sink = sinkFor(received);
        const bool isRead = module().functions->readMemory(
            reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), &sink);
        EXPECT_EQ(isRead, received.problem.empty());
        return received;
    }
    static std::string exrOf(const Image& image) {
        Received received;
        const KaustikImageSink sink = sinkFor(received);
        EXPECT_TRUE(module().functions->encodeExr(image.values.data(), image.width, image.height,
                                                  image.channels, &sink))
            << received.problem;
        return received.bytes;
    }
    static std::string pngOf(const Image& image) {
        Received received;
        const KaustikImageSink sink = sinkFor(received);
        const std::vector<unsigned char> values = toEightBits(image);
        EXPECT_TRUE(module().functions->encodePng(values.data(), image.width, image.height,
                                                  image.channels, &sink))
            << received.problem;
        return received.bytes;
    }
    static bool hasOther() {
        return loadImageModule(helperFolder() / "kaustik_openimageio.so").functions != nullptr;
    }
    TemporaryFolder folder_;
};

// Every pixel another, none between 0 and 1 alone.
Image someImage(int channels) {
    Image image(5, 4, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = std::ldexp(1.0f + 0x1p-23f, static_cast<int>(i) - 30);
    image.values[1] = -0.1f;
    image.values.back() = std::numeric_limits<float>::infinity();
    return image;
}

TEST_F(ExrPng, KeepsEveryFloatOfAnExrBitForBit) {
    for (const int channels : {1, 2, 3, 4}) {
        const Image image = someImage(channels);
        const Received back = decode(exrOf(image));
        EXPECT_EQ(back.image.channels, channels);
        EXPECT_EQ(back.image.values, image.values) << channels;
    }
}

TEST_F(ExrPng, ReadsWhatOpenImageIoWritesAndTheOtherWayRound) {
    if (!hasOther()) GTEST_SKIP() << "built without OpenImageIO";
    for (const int channels : {1, 2, 3, 4}) {
        const Image image = someImage(channels);
        EXPECT_EQ(decode(encodeExr(image, "a.exr")).image.values, image.values) << channels;
        EXPECT_EQ(decodeByModule(exrOf(image), "a.exr").values, image.values) << channels;
        const Image decodedOurs = decode(encodePng(image, toEightBits(image), "a.png")).image;
        const Image decodedTheirs = decodeByModule(pngOf(image), "a.png");
        EXPECT_EQ(decodedOurs.channels, channels);
        EXPECT_EQ(decodedOurs.values, decodedTheirs.values) << channels;
        EXPECT_FLOAT_EQ(decodedOurs.values.back(), 1.0f);
    }
}

TEST_F(ExrPng, ReadsAndWritesLayersAsOpenImageIoDoes) {
    if (!hasOther()) GTEST_SKIP() << "built without OpenImageIO";
    LayeredImage image;
    image.addLayer("", someImage(3));
    image.addLayer("TT.error", someImage(3));
    image.attributes = {{"kaustik.key", "0123"}};
    const auto expectSame = [&](const LayeredImage& read) {
        for (const char* layer : {"", "TT.error"})
            EXPECT_EQ(read.layer(layer, "file").values, image.layer(layer, "file").values);
    };
    writeLayers(folder_ / "theirs.exr", image);
    Received theirs;
    KaustikImageSink sink = sinkFor(theirs);
    ASSERT_TRUE(module().functions->readLayers((folder_ / "theirs.exr").c_str(), &sink))
        << theirs.problem;
    expectSame({theirs.image.width, theirs.image.height, theirs.channels, theirs.image.values, {}});

    std::vector<const char*> channels;
    for (const std::string& channel : image.channels)
        channels.push_back(channel.c_str());
    const char* name = "kaustik.key";
    const char* value = "0123";
    const KaustikImageLayers layers{channels.data(), 1, &name, &value};
    Received ours;
    sink = sinkFor(ours);
    ASSERT_TRUE(module().functions->encodeLayers(image.values.data(), image.width, image.height, 6,
                                                 &layers, &sink))
        << ours.problem;
    writeFileWhole(folder_ / "ours.exr", ours.bytes);
    const LayeredImage read = readLayers(folder_ / "ours.exr");
    expectSame(read);
    EXPECT_EQ(read.attribute(name), value);
}

TEST_F(ExrPng, ReadsAFileAndSaysThatOneIsNotThere) {
    const Image image = someImage(3);
    writeFileWhole(folder_ / "a.exr", exrOf(image));
    for (const char* name : {"a.exr", "none.exr"}) {
        Received received;
        const KaustikImageSink sink = sinkFor(received);
        const bool isRead = module().functions->readFile((folder_ / name).c_str(), &sink);
        EXPECT_EQ(isRead, std::strcmp(name, "a.exr") == 0);
        if (isRead) {
            EXPECT_EQ(received.image.values, image.values);
        } else {
            EXPECT_THAT(received.problem, HasSubstr("cannot be opened"));
        }
    }
}

// OpenEXR makes room for it before it reads.
TEST_F(ExrPng, AnAttributeThatHasNotTheSizeThatItSaysIsAnErrorBeforeRoomIsMade) {
    const std::string sane = exrOf(someImage(3));
    const auto problemWith = [&](const std::string& attribute) {
        return decode(sane.substr(0, 8) + attribute + sane.substr(8)).problem;
    };
    using namespace std::string_literals;
    const std::string head = "a\0string\0"s;
    EXPECT_THAT(problemWith(head + "\2\0\0\0ab"s), Not(HasSubstr("header ends early")));
    for (const std::string& attribute :
         {head + "\xff\xff\xff\x7f"s, "a\0stringvector\0\6\0\0\0\xff\xff\xff\x7f"s + "ab"}) {
        EXPECT_THAT(problemWith(attribute), HasSubstr("header ends early")) << attribute;
    }
    for (const std::string& attribute : {
             "a\0preview\0\14\0\0\0\xff\xff\0\0\xff\xff\0\0"s + "abcd",
             "a\0preview\0\14\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff"s + "abcd",
             "a\0box2i\0\4\0\0\0"s + "abcd",
             "a\0floatvector\0\5\0\0\0"s + "abcde",
         }) {
        EXPECT_THAT(problemWith(attribute), HasSubstr("attribute 'a' of type")) << attribute;
    }
}

// Without its last bytes a file is an error or, where only a trailer is missing, the whole image.
TEST_F(ExrPng, AFileCutOffAnywhereIsAnErrorOrWhole) {
    Image image(3, 2, 3);
    image.values.assign(image.values.size(), 0.5f);
    image.values[4] = 1.0f;
    for (const std::string& whole : {exrOf(image), pngOf(image)}) {
        const std::vector<float> values = decode(whole).image.values;
        ASSERT_EQ(values.size(), image.values.size());
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const Received cut = decode(whole.substr(0, size));
            if (cut.problem.empty()) {
                EXPECT_EQ(cut.image.values, values) << size;
            }
        }
    }
}

TEST_F(ExrPng, AnyOtherFileIsRefusedInASentence) {
    EXPECT_THAT(decode("\xff\xd8\xff and so on").problem, HasSubstr("nor of a PNG"));
    EXPECT_THAT(decode("").problem, HasSubstr("nor of a PNG"));
}

// Written by Python's zlib and struct: 2 x 2 pixels of 16 bits, grey with alpha, "abcdefgh" and
// "ijklmnop"; of one bit, in two colors; of 8 bits, interlaced.
const std::string k16Bits = fromHex(
    "89504e470d0a1a0a0000000d4948445200000002000000021004000000882f19ec0000001a49444154789c63"
    "484c4a4e494d4bcf60c8cccacec9cdcb2f0000396606898a9bec280000000049454e44ae426082");
const std::string kPalette = fromHex(
    "89504e470d0a1a0a0000000d494844520000000200000002010300000048789f6700000006504c5445010203"
    "04050695536f480000000c49444154789c637060680000014400c13a7a1c560000000049454e44ae426082");
const std::string kInterlaced = fromHex(
    "89504e470d0a1a0a0000000d494844520000000200000002080000000120da626e0000000f49444154789c63"
    "48644862484e010004ff018bd537d1f80000000049454e44ae426082");

TEST_F(ExrPng, ReadsPngsOfAllDepths) {
    const Received wide = decode(k16Bits);
    ASSERT_EQ(wide.image.channels, 2);
    EXPECT_FLOAT_EQ(wide.image.at(1, 0, 0), static_cast<float>(0x6566) / 65535.0f);
    EXPECT_FLOAT_EQ(wide.image.at(0, 1, 1), static_cast<float>(0x6b6c) / 65535.0f);
    const Received colors = decode(kPalette);
    ASSERT_EQ(colors.image.channels, 3);
    EXPECT_FLOAT_EQ(colors.image.at(0, 0, 0), 1.0f / 255.0f);
    EXPECT_FLOAT_EQ(colors.image.at(1, 0, 2), 6.0f / 255.0f);
    EXPECT_FLOAT_EQ(colors.image.at(0, 1, 1), 5.0f / 255.0f);
    const Received passes = decode(kInterlaced);
    ASSERT_EQ(passes.image.channels, 1);
    for (int i = 0; i < 4; ++i)
        EXPECT_FLOAT_EQ(passes.image.at(i % 2, i / 2, 0), static_cast<float>('a' + i) / 255.0f);
}

std::string bigEndian(std::uint32_t value) {
    std::string bytes;
    for (const unsigned shift : {24u, 16u, 8u, 0u})
        bytes += static_cast<char>(value >> shift);
    return bytes;
}

// Of PNG, section 5.5 (ISO 15948).
std::uint32_t checksum(const std::string& bytes) {
    std::uint32_t sum = ~0u;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit)
            sum = (sum >> 1u) ^ ((sum & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return ~sum;
}

TEST_F(ExrPng, AHeaderThatClaimsTooManyPixelsIsAnError) {
    std::string bytes = pngOf(Image(2, 2, 4));
    // Signature and length, "IHDR", width, …, and its checksum.
    bytes.replace(16, 4, bigEndian(100'000));
    bytes.replace(29, 4, bigEndian(checksum(bytes.substr(12, 17))));
    EXPECT_THAT(decode(bytes).problem, HasSubstr("100000x2"));
    // The data window's last column follows its name, its type and its size.
    std::string exr = exrOf(Image(2, 2, 3));
    const std::string window = std::string("dataWindow") + '\0' + "box2i" + '\0';
    const std::size_t at = exr.find(window) + window.size() + 4;
    exr.replace(at + 8, 4, std::string("\x00\x00\x00\x08", 4));
    EXPECT_THAT(decode(exr).problem, HasSubstr("data window"));
}

}  // namespace
}  // namespace kaustik
