// SPDX-License-Identifier: MIT
// The panel Image and what is read off the picture: textures, layers, values of pixels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/core/files.h"
#include "framework/image/image.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class ImagePanel : public WorkbenchTest {
  protected:
    // What the line under the picture says of the pixel that the mouse is on: "(x, y)  v v v".
    [[nodiscard]] std::vector<double> valuesUnderMouse() {
        std::istringstream line(bench->value("picture.value"));
        line.ignore(100, ')');
        std::vector<double> values;
        // Between the names of channels and units, of which some begin with a figure.
        for (std::string word; line >> word;) {
            std::size_t end = 0;
            try {
                const double value = std::stod(word, &end);
                if (end == word.size()) values.push_back(value);
            } catch (const std::exception&) {
            }
        }
        return values;
    }
    // A texture as `kaustik run` saves it.
    [[nodiscard]] Image saved(const std::string& resource, const std::string& file = "") {
        renderSmall({"--save", resource, "--out", "saved"});
        return readImage(folder / "saved" /
                         ((file.empty() ? resource : file) + floatImageExtension()));
    }
};

// Five digits are shown.
constexpr double kShownDigits = 1e-4;

TEST_F(ImagePanel, AnyTextureIsShownWithItsLayersAndValues) {
    start();
    open("Image");
    const Image picture = seenPicture();
    choose("image.texture", "layers.depth");
    untilSettled();
    EXPECT_EQ(bench->value("image.layer"), "0");
    bench->typeInto("image.layer", "1", Entry::controlClick);
    untilSettled();
    EXPECT_GT(largestDifference(seenPicture(), picture), 0.1);
    bench->keepScreenshot("image-layer");
    const Image layer = saved("layers.depth", "layers.depth.1");
    for (const auto& [x, y] : {std::pair{32, 26}, std::pair{24, 20}, std::pair{40, 34}}) {
        bench->hover("picture.image", pixel(x, y));
        EXPECT_TRUE(bench->value("picture.value").starts_with(fmt::format("({}, {})", x, y)));
        const std::vector<double> values = valuesUnderMouse();
        // One more is the figure of "material + 1".
        ASSERT_EQ(values.size(), 5u) << bench->value("picture.value");
        for (int c = 0; c < 3; ++c) {
            const auto expected = static_cast<double>(layer.at(x, y, c));
            EXPECT_NEAR(values[static_cast<std::size_t>(c)], expected,
                        kShownDigits * std::abs(expected));
        }
    }
}

TEST_F(ImagePanel, TheListSaysWhatTexturesAreAndOneOfTheLastFrameRendersNothing) {
    start();
    open("Image");
    const int frame = bench->status().at("frame");
    bench->click("image.texture");
    bench->type("caustic.irr");
    ASSERT_TRUE(bench->has("image.texture=caustic.irradiance"));
    EXPECT_EQ(bench->value("image.texture=caustic.irradiance"),
              "64x48 RGBA32F | W/m² | gather.screen");
    bench->keepScreenshot("image-list");
    bench->click("image.texture=caustic.irradiance");
    untilSettled();
    EXPECT_TRUE(bench->value("picture.caption").starts_with("caustic.irradiance"));
    EXPECT_TRUE(says("image.writers", "gather.screen"));
    EXPECT_EQ(bench->status().at("frame"), frame);
    // The same values that a frame has which is rendered for it.
    bench->hover("picture.image", pixel(30, 30));
    const std::string looked = bench->value("picture.value");
    bench->click("image.texture");
    bench->click("image.texture=picture");
    untilSettled();
    EXPECT_EQ(bench->status().at("frame"), frame) << "and back";
    renderSmall({"--save", "caustic.irradiance", "--out", "saved"});
    const Image saved =
        readImage(folder / "saved" / ("caustic.irradiance" + floatImageExtension()));
    EXPECT_NEAR(std::stod(looked.substr(looked.find("red ") + 4)),
                static_cast<double>(saved.at(30, 30, 0)),
                1e-4 * static_cast<double>(saved.at(30, 30, 0)) + 1e-6);
}

TEST_F(ImagePanel, MipsOfAPyramidAreInTheListByName) {
    start();
    open("Image");
    const int frame = bench->status().at("frame");
    bench->click("image.texture");
    bench->type("pyramid");
    EXPECT_TRUE(
        bench->value("image.texture=layers.pyramid: squares of 16 pixels").starts_with("4x3 | "));
    bench->click("image.texture=layers.pyramid: squares of 16 pixels");
    untilSettled();
    // Four columns of squares are as wide as the pane, or three rows as high.
    const Rectangle area = bench->control("picture");
    const Rectangle image = bench->control("picture.image");
    const double zoom = image.w / 20.0;  // 16 columns of squares of 4 pixels, and these
    EXPECT_NEAR(std::max(4.0 * zoom / area.w, 3.0 * zoom / area.h), 1.0, 0.02);
    EXPECT_NEAR(image.x + 18.0 * zoom, area.x + 0.5 * area.w, 2.0) << "it is in the middle";
    EXPECT_EQ(bench->status().at("frame"), frame) << "the tracer has made it";
    bench->keepScreenshot("image-mip");
}

TEST_F(ImagePanel, ALayerThatIsNotThereIsNotShownUnderItsNumber) {
    json kept = savedStateShowing("layers.depth", 6);
    kept["document"]["variant"]["set"]["layers.count"] = "8";
    start(kept);
    open("Image");
    EXPECT_EQ(bench->value("shown"), "asked");
    EXPECT_TRUE(says("picture.caption", "layers.depth · surface 7 from the front · depth, m"));
    open("Parameters");
    bench->typeInto("parameter.layers.count", "4", Entry::controlClick);
    untilSettled();
    EXPECT_EQ(bench->value("picture"), "empty");
    EXPECT_EQ(bench->value("shown"), "stale");
    EXPECT_TRUE(says("shown.sentence", "'layers.depth' has no layer 6"));
    EXPECT_TRUE(says("shown.sentence", "0 to 3"));
    bench->keepScreenshot("image-no-layer");
    bench->click("shown.remedy");
    untilSettled();
    EXPECT_EQ(bench->value("shown"), "asked");
    EXPECT_TRUE(says("picture.caption", "layers.depth · surface 4 from the front · depth, m"));
    open("Image");
    EXPECT_EQ(bench->value("image.layer"), "3");
}

TEST_F(ImagePanel, ATextureThatIsNoLongerThereIsSaidToBeGone) {
    start(savedStateShowing("shadow.maps"));
    EXPECT_EQ(bench->value("shown"), "asked");
    open("Technique");
    choose("stage.shadow", "rays");
    untilSettled();
    EXPECT_EQ(bench->value("shown"), "stale");
    EXPECT_TRUE(says("shown.sentence", "no texture 'shadow.maps'"));
    bench->click("shown.remedy");
    untilSettled();
    EXPECT_TRUE(says("shown.sentence", "What is shown is what was asked for"));
    EXPECT_EQ(bench->value("picture.caption"), "picture · the eye's view");
}

// What is not seen by the eye has nothing drawn over it, and no hand on it moves the eye.
TEST_F(ImagePanel, AMapIsNoViewOfTheEye) {
    json kept = savedStateShowing("shadow.maps");
    kept["view"]["shows_lights"] = true;
    start(kept);
    EXPECT_TRUE(says("picture.caption", "depth, m · a light's view"));
    EXPECT_FALSE(bench->has("light.sun"));
    const json before = document();
    bench->drag("picture", 40, 10);
    bench->hover("picture");
    bench->key("w");
    EXPECT_EQ(document(), before);
    bench->key("0");
    bench->key("p");
    bench->click("picture.image");
    EXPECT_TRUE(says("status.message", "eye's view")) << bench->value("status.message");
    EXPECT_TRUE(says("status.message", "a light's view"));
}

// Stored light is light, and no words of fixed point: all of it is what the ledger has deposited.
TEST_F(ImagePanel, StoredLightIsShownInWatts) {
    start(savedStateShowing("caustic.flux"));
    open("Image");
    EXPECT_FALSE(bench->has("image.layer")) << "words are no layers";
    EXPECT_TRUE(says("picture.caption", "flux that has arrived, W · the eye's view"));
    bench->click("image.save");
    bench->waitFor("the file", [](const json& screen) {
        return screen.at("status").at("message").get<std::string>().starts_with("Wrote ");
    });
    double sum = 0.0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        if (entry.path().extension() != floatImageExtension()) continue;
        const Image flux = readImage(entry.path());
        for (const float value : flux.values)
            sum += static_cast<double>(value) / 3.0;
        // The file says what it is.
        const std::string bytes = readFile(entry.path());
        EXPECT_NE(bytes.find("flux that has arrived, W"), std::string::npos);
        EXPECT_NE(bytes.find("emit.photons=32x32"), std::string::npos);
    }
    open("Error");
    bench->click("table.csv.energy");
    std::string csv;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        if (entry.path().extension() == ".csv") csv = readFile(entry.path());
    }
    const std::size_t at = csv.find("deposited,");
    ASSERT_NE(at, std::string::npos) << csv;
    const double deposited = std::stod(csv.substr(at + 10));
    EXPECT_GT(deposited, 0.0);
    EXPECT_NEAR(sum, deposited, 1e-5 * deposited);
}

TEST_F(ImagePanel, ATextureThatNothingNeedsIsMadeToBeSeen) {
    json kept = savedStateWith(smallDocument());
    kept["document"]["variant"]["disable"] = {"compose.direct"};
    start(kept);
    EXPECT_EQ(bench->value("passes.name.shadow.map"), "culled");
    open("Image");
    choose("image.texture", "shadow.visibility");
    untilSettled();
    EXPECT_EQ(bench->value("passes.name.shadow.map"), "ran");
    EXPECT_EQ(bench->value("passes.name.shadow.lookup"), "ran");
}

TEST_F(ImagePanel, ChannelsExposureAndFalseColoursChangeHowItIsSeen) {
    json kept = savedStateShowing("caustic.irradiance");
    kept["view"]["looks"]["caustic.irradiance"] = {{"exposure_automatic", false}};
    start(kept);
    open("Image");
    const Image plain = seenPicture();
    bench->click("image.fit");
    // The brightest hundredth of what is lit is white, and hardly more.
    const float brightest = 1000.0f;  // W/m², the sun's; the caustic's is up to twice as much
    EXPECT_NEAR(std::stof(bench->value("image.exposure")), -std::log2(1.5f * brightest), 0.6f);
    EXPECT_LT(meanOf(seenPicture()), meanOf(plain));
    bench->typeInto("image.exposure", "-6", Entry::controlClick);
    const Image darker = seenPicture();
    EXPECT_LT(meanOf(darker), meanOf(plain));
    bench->key("+");
    EXPECT_EQ(bench->value("image.exposure"), "-5.5");
    EXPECT_GT(meanOf(seenPicture()), meanOf(darker));
    bench->key("-");

    bench->key("f");
    EXPECT_EQ(bench->value("image.false_color"), "on");
    const Image coloured = seenPicture();
    bench->keepScreenshot("image-false-colours");
    // White light on grey chalk has no hue; false colours have.
    const auto hue = [](const Image& image) {
        double largest = 0.0;
        for (std::size_t i = 0; i + 2 < image.values.size(); i += 3) {
            largest = std::max(
                largest, static_cast<double>(std::abs(image.values[i] - image.values[i + 2])));
        }
        return largest;
    };
    EXPECT_LT(hue(darker), 0.02);
    EXPECT_GT(hue(coloured), 0.3);
    bench->click("image.range_automatic");
    EXPECT_TRUE(bench->has("image.range.low"));
    // Another texture has a look of its own.
    choose("image.texture", "direct.irradiance");
    untilSettled();
    EXPECT_EQ(bench->value("image.false_color"), "off");
    EXPECT_EQ(bench->value("image.fit"), "on");
    choose("image.texture", "caustic.irradiance");
    untilSettled();
    EXPECT_EQ(bench->value("image.false_color"), "on");
    bench->key("f");
    EXPECT_EQ(largestDifference(seenPicture(), darker), 0.0);
    choose("image.channel", "alpha");
    EXPECT_GT(largestDifference(seenPicture(), darker), 0.1);
}

TEST_F(ImagePanel, TheWheelZoomsToThePixelUnderTheMouseUntilItsValuesAreWritten) {
    start(savedStateShowing("caustic.irradiance"));
    const Image whole = seenPicture();
    const Spot spot = {0.6, 0.55};
    bench->hover("picture", spot);
    const std::string before = bench->value("picture.value");
    EXPECT_FALSE(bench->has("picture.values"));
    bench->wheel("picture", 9, spot);
    bench->waitFor("values in the pixels", [](const json& screen) {
        return screen.at("controls").contains("picture.values");
    });
    EXPECT_EQ(bench->value("picture.value"), before);
    bench->keepScreenshot("image-values");
    const double x = bench->control("picture.image").x;
    bench->drag("picture", 70, 0, kMiddleButton);
    EXPECT_NEAR(bench->control("picture.image").x, x + 70.0, 2.0);
    EXPECT_FALSE(document().at("edits").contains("camera"));
    bench->key("0");
    EXPECT_FALSE(bench->has("picture.values"));
    EXPECT_EQ(largestDifference(seenPicture(), whole), 0.0);
    bench->click("toolbar.one_to_one");
    EXPECT_EQ(bench->control("picture.image").w, 64.0);
    bench->click("toolbar.fit");
    EXPECT_EQ(largestDifference(seenPicture(), whole), 0.0);
}

}  // namespace
}  // namespace kaustik::test
