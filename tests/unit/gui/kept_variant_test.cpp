// SPDX-License-Identifier: MIT
// What is kept of a variant, how two differ, and what tables and files say of it.
#include "framework/gui/kept_variant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/gui/image_metadata.h"
#include "framework/gui/shown_image.h"
#include "framework/image/image.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::gui::test {
namespace {

Image filled(float value, int channels = 4) {
    Image image(16, 16, channels);
    std::fill(image.values.begin(), image.values.end(), value);
    return image;
}

class KeptVariantTest : public testing::Test {
  protected:
    KeptVariantTest() {
        VariantResult& variant = result.variants[0];
        variant.isSettled = true;
        variant.frameMs = {100.0, 5.0, 7.0, 6.0};
        variant.warnings = {"It joins nothing."};
        ViewedTexture& viewed = variant.viewed.emplace();
        viewed.name = "hits.flux";
        viewed.values = filled(1.0f);
        ViewedTexture irradiance;
        irradiance.name = "caustic.irradiance";
        irradiance.values = filled(2.0f);
        variant.outputTextures = {std::make_shared<const ViewedTexture>(irradiance)};
        result.document.variant.technique = "planar";
        result.document.variant.assignments["emit.photons"] = "64x64";
    }
    FrameResult result;
    ReferenceState reference;
    std::string problem;
};

TEST_F(KeptVariantTest, HasSettingsPicturesAndTimesTogether) {
    const std::optional<KeptVariant> kept = keep(result, 0, reference, problem);
    ASSERT_TRUE(kept) << problem;
    EXPECT_EQ(kept->name, "planar, emit.photons=64x64");
    EXPECT_EQ(kept->document.variant, result.document.variant);
    EXPECT_EQ(kept->frameMs, 6.0) << "without the frame that compiles";
    ASSERT_TRUE(kept->texture("hits.flux") && kept->texture("caustic.irradiance"));
    EXPECT_EQ(kept->texture("caustic.irradiance")->values.values[0], 2.0f);
    EXPECT_EQ(kept->texture("eye.receiver"), nullptr);
    EXPECT_EQ(kept->reservations, std::vector<std::string>{"It joins nothing."});
    EXPECT_EQ(kept->bytes, 2u * 16u * 16u * 4u * sizeof(float));
    EXPECT_EQ(kept->judgement.order, 0u) << "by no reference";
}

TEST_F(KeptVariantTest, IsOnlyWhatHasSettledAndHasRoom) {
    KeptVariant one = *keep(result, 0, reference, problem);
    EXPECT_EQ(whyNoRoom({}, one), "");
    EXPECT_NE(whyNoRoom(std::vector<KeptVariant>(kMaxKept, one), one), "");
    one.bytes = kMaxKeptBytes;
    EXPECT_EQ(whyNoRoom({}, one), "");
    EXPECT_NE(whyNoRoom({one}, one).find("1024 MiB at most"), std::string::npos);
    result.variants[0].isSettled = false;
    EXPECT_FALSE(keep(result, 0, reference, problem));
    EXPECT_NE(problem.find("settled"), std::string::npos);
}

TEST(ImageDifference, HasASignAndItsMeasures) {
    Image brighter = filled(3.0f);
    const ImageDifference difference = differenceBetween(brighter, filled(1.0f, 4));
    EXPECT_NEAR(difference.rmse, 2.0, 1e-6);
    EXPECT_EQ(difference.signedMean->at(5, 5, 0), 2.0f);
    EXPECT_EQ(differenceBetween(filled(1.0f), brighter).signedMean->at(5, 5, 0), -2.0f);
    EXPECT_NEAR(differenceBetween(brighter, brighter).flip.value_or(1.0), 0.0, 1e-6);
    // Alpha is no light.
    brighter.at(0, 0, 3) = 100.0f;
    EXPECT_NEAR(differenceBetween(brighter, filled(1.0f)).rmse, 2.0, 1e-6);
    EXPECT_NE(differenceBetween(brighter, Image(2, 2, 4)).problem.find("2×2"), std::string::npos);
    brighter.at(0, 0, 0) = std::nanf("");
    EXPECT_NE(differenceBetween(brighter, filled(1.0f)).problem, "");
}

TEST(Table, IsTextInLineAndCsvWithQuotes) {
    const Table table{{"pass", "median, ms"}, {{"é", "1"}, {"trace \"a\"", "20"}}};
    EXPECT_EQ(toText(table), "pass       median, ms\né          1\ntrace \"a\"  20\n");
    EXPECT_EQ(toCsv(table), "pass,\"median, ms\"\r\né,1\r\n\"trace \"\"a\"\"\",20\r\n");
}

class ImageMetadata : public testing::Test {
  protected:
    const kaustik::test::TemporaryFolder folder;
    Image image = filled(0.25f, 3);
    const Metadata metadata = {{"image", "caustic.irradiance · W/m²"}, {"scene", "pool"}};
};

TEST_F(ImageMetadata, IsInTheFileAndLeavesThePixelsAlone) {
    if (!hasImageModule()) GTEST_SKIP() << "no module for EXR and PNG";
    image.at(3, 4, 1) = 1.0f;
    // More rows than a chunk of an EXR has.
    Image tall(16, 70, 4);
    for (std::size_t i = 0; i < tall.values.size(); ++i)
        tall.values[i] = static_cast<float>(i);
    writeImage(folder / "a.png", image);
    writeImage(folder / "a.exr", tall);
    writeFileWhole(folder / "b.png", withPngText(readFile(folder / "a.png"), metadata));
    writeFileWhole(folder / "b.exr", withExrAttributes(readFile(folder / "a.exr"), metadata));
    EXPECT_EQ(readImage(folder / "b.png").values, readImage(folder / "a.png").values);
    EXPECT_EQ(readImage(folder / "b.exr").values, tall.values);
    for (const char* file : {"b.png", "b.exr"}) {
        const std::string bytes = readFile(folder / file);
        EXPECT_NE(bytes.find("caustic.irradiance · W/m²"), std::string::npos) << file;
        EXPECT_NE(bytes.find("pool"), std::string::npos) << file;
    }
}

TEST_F(ImageMetadata, IsNotPutIntoWhatIsNoSuchFile) {
    EXPECT_THROW(static_cast<void>(withPngText("no picture", metadata)), IoError);
    EXPECT_THROW(static_cast<void>(withExrAttributes("no picture at all", metadata)), IoError);
}

}  // namespace
}  // namespace kaustik::gui::test
