// SPDX-License-Identifier: MIT
// The panel Image and what is read off the picture: textures, layers, values of pixels, values that
// are no numbers, photons.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/core/files.h"
#include "framework/image/image.h"
#include "tests/gui/shader_copies.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class ImagePanel : public WorkbenchTest {
  protected:
    static json showing(const std::string& resource, int layer = 0) {
        json kept = savedStateWith(smallDocument());
        kept["view"]["resource"] = resource;
        kept["view"]["layer"] = layer;
        return kept;
    }
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
    json kept = showing("layers.depth", 6);
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
    start(showing("shadow.maps"));
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
    json kept = showing("shadow.maps");
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
    start(showing("caustic.flux"));
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
    json kept = showing("caustic.irradiance");
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
    EXPECT_TRUE(bench->has("image.range"));
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
    start(showing("caustic.irradiance"));
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

// What composes the receivers' radiance for a `pixel`, edited while it is looked at.
class EditedShaders : public ImagePanel {
  protected:
    // Puts a line at its beginning.
    void edit(const std::string& line) const {
        shaders.write(kShader,
                      original.substr(0, place()) + line + "\n" + original.substr(place()));
    }
    [[nodiscard]] long lineOfEdit() const {
        return 1 +
               std::count(original.begin(), original.begin() + static_cast<long>(place()), '\n');
    }
    [[nodiscard]] std::size_t place() const {
        return original.find('\n', original.find("ivec2 pixel = ")) + 1;
    }
    void start(const std::string& resource = "compose.receiver_radiance") {
        json kept = showing(resource);
        kept["view"]["looks"][resource] = {{"exposure_automatic", false},
                                           {"exposure", -8.0}};  // up to 256 W/m²/sr are told apart
        WorkbenchTest::start(kept, shaders.environment());
        open("Image");
    }
    void untilShaderIs(bool isBroken) {
        bench->waitFor(isBroken ? "the shader's error" : "a mended shader",
                       [&](const json& screen) {
                           return screen.at("controls").contains("status.shader") == isBroken;
                       });
    }
    void untilNotFinite(const std::string& count) {
        bench->waitFor("so many values that are not finite: " + count, [&](const json& screen) {
            return screen.at("controls").at("image.not_finite").at("value") == count;
        });
    }
    // A column of NaN in red, half of it of infinity in green: 48 + 24 values.
    static constexpr const char* kNotFinite =
        "if (pixel.x == 5) {\n"
        "    radiance = vec4(intBitsToFloat(0x7fc00000), 1.0, 1.0, 1.0);\n"
        "    if (pixel.y % 2 == 0) radiance.g = intBitsToFloat(0x7f800000);\n"
        "    return;\n"
        "}";

    static constexpr const char* kShader = "compose/picture_radiance.frag";
    ShaderCopies shaders{folder / "root"};
    std::string original = shaders.read(kShader);
};

TEST_F(EditedShaders, ValuesThatAreNoNumbersAreFlaggedAndCounted) {
    start();
    EXPECT_EQ(bench->value("image.not_finite"), "0");
    edit(kNotFinite);
    untilNotFinite("72");
    bench->keepScreenshot("image-not-finite");
    edit("");
    untilNotFinite("0");
}

// Whose own values are colours, of which all are numbers.
TEST_F(EditedShaders, ThePictureOfSuchValuesIsNotSaidToBeFinite) {
    start("");
    EXPECT_EQ(bench->value("image.not_finite"), "0");
    edit(kNotFinite);
    // As many, or more where they are seen through the water, too.
    bench->waitFor("values that are not finite", [](const json& screen) {
        return std::stoi(
                   screen.at("controls").at("image.not_finite").at("value").get<std::string>()) >=
               72;
    });
    bench->keepScreenshot("image-not-finite-picture");
}

TEST_F(EditedShaders, ABrokenShaderIsExplainedAndTheLastGoodOneStaysInUse) {
    start();
    const Image before = seenPicture();
    edit("radiance = noSuchThing;");
    untilShaderIs(true);
    EXPECT_TRUE(says("status.shader", "shaders/compose/picture_radiance.frag"));
    EXPECT_TRUE(says("status.shader", fmt::format(":{}:", lineOfEdit())))
        << bench->value("status.shader");
    EXPECT_TRUE(says("status.shader", "noSuchThing"));
    untilSettled();
    EXPECT_EQ(largestDifference(seenPicture(), before), 0.0);
    bench->keepScreenshot("image-broken-shader");
    edit("radiance = vec4(64.0); return;");
    untilShaderIs(false);
    untilSettled();
    const Image grey = seenPicture();
    EXPECT_EQ(std::count(grey.values.begin(), grey.values.end(), grey.values.front()),
              static_cast<std::ptrdiff_t>(grey.values.size()));
    edit("");
    bench->waitFor("the picture of before",
                   [&](const json&) { return largestDifference(seenPicture(), before) == 0.0; });
}

// Where the photons of a run went that another process made, with the camera of the scene's file.
class ProbedPhotons : public ImagePanel {
  protected:
    ProbedPhotons() {
        renderSmall({"--save", "hits.position_1", "--save", "hits.flux_1", "--out", "hits"});
        const Image positions = readImage(folder / "hits" / ("hits.position_1" + extension));
        const Image fluxes = readImage(folder / "hits" / ("hits.flux_1" + extension));
        constexpr float reachedReceiver = 2.0f;
        const double tangent = std::tan(45.0 / 2.0 * std::acos(-1.0) / 180.0);
        for (int y = 0; y < positions.height; ++y) {
            for (int x = 0; x < positions.width; ++x) {
                if (fluxes.at(x, y, 3) != reachedReceiver) continue;
                const auto at = [&](int c) { return static_cast<double>(positions.at(x, y, c)); };
                const double scale = 24.0 / (tangent * -at(2));
                landings.emplace_back(32.0 + scale * at(0), 24.0 - scale * at(1));
            }
        }
    }
    [[nodiscard]] std::ptrdiff_t landedWithin(double radius, int x, int y) const {
        return std::count_if(landings.begin(), landings.end(), [&](const auto& landing) {
            return std::hypot(landing.first - x - 0.5, landing.second - y - 0.5) <= radius;
        });
    }
    [[nodiscard]] long probed(int x, int y) {
        bench->click("picture.image", kLeftButton, pixel(x, y));
        untilSettled();
        bench->waitFor("photons", [](const json& screen) {
            return screen.at("controls").contains("image.probe_landed");
        });
        return std::stol(bench->value("image.probe_landed"));
    }

    std::string extension = floatImageExtension();
    std::vector<std::pair<double, double>> landings;
};

TEST_F(ProbedPhotons, AreAsManyAsLandedNearThePixel) {
    ASSERT_GT(landings.size(), 500u);
    start();
    open("Image");
    bench->hover("picture");
    bench->key("p");
    EXPECT_EQ(bench->value("image.probe"), "on");
    for (const auto& [x, y] : {std::pair{32, 25}, std::pair{26, 30}, std::pair{37, 20}}) {
        EXPECT_EQ(probed(x, y), landedWithin(1.0, x, y)) << x << ", " << y;
    }
    EXPECT_EQ(probed(2, 2), 0) << "beside the scene";
    bench->typeInto("image.probe_radius", "4", Entry::controlClick);
    const long many = probed(32, 25);
    EXPECT_EQ(many, landedWithin(4.0, 32, 25));
    EXPECT_GT(many, landedWithin(1.0, 32, 25));
    bench->keepScreenshot("image-photons");
    // Their paths are drawn over the picture.
    const Image ways = seenPicture();
    bench->key("p");
    EXPECT_GT(largestDifference(seenPicture(), ways), 0.1);
    EXPECT_FALSE(document().at("edits").contains("camera"));
}

}  // namespace
}  // namespace kaustik::test
