// SPDX-License-Identifier: MIT
// Where the parts of textures lie, and small copies of them.
#include "framework/gui/texture_reader.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace kaustik::gui::test {
namespace {

using Region = ViewedTexture::Region;

// Of any size the mips lie next to each other in a texture as large as layers.pyramid makes it.
TEST(Pyramid, HasItsMipsByNameSideBySide) {
    for (const auto& [width, height] : {std::pair{800, 600}, {801, 601}, {64, 48}, {5, 3}}) {
        const std::vector<Region> mips = regionsOfPyramid(width, height);
        ASSERT_EQ(mips.size(), 3u);
        EXPECT_EQ(mips[0].name, "squares of 4 pixels");
        EXPECT_EQ(mips[2].name, "squares of 64 pixels");
        int side = 4;
        for (const Region& mip : mips) {
            EXPECT_GE(mip.width * side, width);
            EXPECT_LT((mip.width - 1) * side, width);
            EXPECT_GE(mip.height * side, height);
            EXPECT_LT((mip.height - 1) * side, height);
            side *= 4;
        }
        EXPECT_EQ(mips[0].x, 0);
        EXPECT_EQ(mips[1].x, mips[0].width);
        EXPECT_EQ(mips[2].x, mips[0].width);
        EXPECT_EQ(mips[2].y, mips[1].y + mips[1].height) << "one above the other";
    }
    EXPECT_EQ(pixelsOfPyramid("layers.pyramid"), "layers.depth");
    EXPECT_EQ(pixelsOfPyramid("layers.depth"), "");
}

TEST(ReducedTexture, HasTheSameProportionsAndEveryNthPixel) {
    ViewedTexture viewed;
    viewed.values = Image(300, 100, 2);
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 300; ++x)
            viewed.values.at(x, y, 1) = static_cast<float>(1000 * y + x);
    }
    const ViewedTexture small = reducedTo(viewed, 128);
    EXPECT_EQ(small.values.width, 100);
    EXPECT_EQ(small.values.height, 34);
    EXPECT_EQ(small.values.channels, 2);
    EXPECT_EQ(small.values.at(99, 33, 1), 1000.0f * 99.0f + 297.0f);
    EXPECT_EQ(reducedTo(viewed, 300).values.values, viewed.values.values) << "it is small enough";
}

}  // namespace
}  // namespace kaustik::gui::test
