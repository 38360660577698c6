// SPDX-License-Identifier: MIT
// Named layers in one OpenEXR file: what is written is read, by either module, and what is no such
// file is refused in a sentence.
#include "framework/image/layered_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/image_limits.h"
#include "framework/image/module_loader.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Image ramp(int width, int height, float first) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = first + 0.1f * static_cast<float>(i);
    return image;
}

LayeredImage twoLayers() {
    LayeredImage image;
    image.addLayer("", ramp(5, 3, 1.0f));
    image.addLayer("TT@a ball.error", ramp(5, 3, -7.0f));
    image.attributes = {{"kaustik.key", "0123"}, {"kaustik.empty", ""}};
    return image;
}

class LayeredImages : public testing::Test {
  protected:
    void SetUp() override {
        if (!hasImageModule()) GTEST_SKIP() << "no module writes .exr here";
    }
    test::TemporaryFolder folder_;
};

TEST(LayeredImage, HasTheChannelsOfItsLayersInTheirOrder) {
    const LayeredImage image = twoLayers();
    EXPECT_THAT(image.channels, ElementsAre("R", "G", "B", "TT@a ball.error.R", "TT@a ball.error.G",
                                            "TT@a ball.error.B"));
    EXPECT_EQ(image.layer("", "file").values, ramp(5, 3, 1.0f).values);
    EXPECT_EQ(image.layer("TT@a ball.error", "file").values, ramp(5, 3, -7.0f).values);
    EXPECT_TRUE(image.hasLayer("TT@a ball.error"));
    EXPECT_FALSE(image.hasLayer("TT@a ball"));
    EXPECT_THAT(test::messageOf<IoError>([&] { static_cast<void>(image.layer("TT", "a.exr")); }),
                HasSubstr("a.exr has no channel 'TT.R'"));
}

TEST_F(LayeredImages, AreReadAsTheyWereWrittenToTheBit) {
    LayeredImage image = twoLayers();
    image.values[0] = std::numeric_limits<float>::denorm_min();
    image.values[1] = std::nextafter(1.0f, 2.0f);
    const auto file = folder_ / "layers.exr";
    writeLayers(file, image);
    const LayeredImage read = readLayers(file);
    EXPECT_EQ(read.width, 5);
    EXPECT_EQ(read.height, 3);
    // A reader may have them in an order of its own.
    EXPECT_EQ(std::set(read.channels.begin(), read.channels.end()),
              std::set(image.channels.begin(), image.channels.end()));
    for (const char* layer : {"", "TT@a ball.error"})
        EXPECT_EQ(read.layer(layer, "file").values, image.layer(layer, "file").values) << layer;
    EXPECT_EQ(read.attribute("kaustik.key"), "0123");
    EXPECT_EQ(read.attribute("kaustik.nothing"), "");
}

TEST_F(LayeredImages, AreTheSameFileEachTime) {
    writeLayers(folder_ / "a.exr", twoLayers());
    writeLayers(folder_ / "b.exr", twoLayers());
    EXPECT_EQ(readFile(folder_ / "a.exr"), readFile(folder_ / "b.exr"));
}

TEST_F(LayeredImages, MayHaveManyMoreChannelsThanOtherImages) {
    LayeredImage image;
    for (int layer = 0; layer < 40; ++layer)
        image.addLayer("class" + std::to_string(layer), ramp(4, 2, static_cast<float>(layer)));
    const auto file = folder_ / "many.exr";
    writeLayers(file, image);
    EXPECT_EQ(readLayers(file).layer("class39", "file").values, ramp(4, 2, 39.0f).values);
    EXPECT_THROW(static_cast<void>(readImage(file)), IoError);
}

TEST_F(LayeredImages, ThatAreNoneAreRefused) {
    const auto file = folder_ / "layers.exr";
    writeLayers(file, twoLayers());
    const std::string bytes = readFile(file);
    const auto refusal = [&](const std::string& content) {
        writeFileWhole(folder_ / "bad.exr", content);
        return test::messageOf<IoError>(
            [&] { static_cast<void>(readLayers(folder_ / "bad.exr")); });
    };
    EXPECT_THAT(refusal(bytes.substr(0, bytes.size() - 40)), HasSubstr("bad.exr cannot be read"));
    EXPECT_THAT(refusal("no image"), HasSubstr("bad.exr cannot be read"));
    EXPECT_THAT(refusal(""), HasSubstr("bad.exr cannot be read"));
    EXPECT_THROW(static_cast<void>(readLayers(folder_ / "missing.exr")), IoError);
    EXPECT_THAT(test::messageOf<IoError>([&] { writeLayers(folder_ / "layers.pfm", twoLayers()); }),
                HasSubstr(".exr alone"));
}

TEST(LayeredImage, OfMoreThanCanBeIsToldBeforeMemoryIsTaken) {
    EXPECT_EQ(layeredSizeProblem(800, 600, 78), "");
    EXPECT_THAT(layeredSizeProblem(0, 600, 3), HasSubstr("no pixels"));
    EXPECT_THAT(layeredSizeProblem(8, 6, 1025), HasSubstr("1 to 1024"));
    EXPECT_THAT(layeredSizeProblem(65536, 65536, 1), HasSubstr("too large"));
    EXPECT_THAT(layeredSizeProblem(8192, 8192, 12), HasSubstr("too large"));
}

}  // namespace
}  // namespace kaustik
