// SPDX-License-Identifier: MIT
// One description of what is on the screen, of which picture, caption, numbers and colour bar are.
#include "framework/gui/shown_image.h"
#include "framework/gui/showing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "framework/gui/texture_reader.h"
#include "framework/render/view.h"

namespace kaustik::gui::test {
namespace {

constexpr std::uint64_t kOrder = 7;

// A technique's irradiance of 788.4 and a reference of 833.67 W/m², 4x2 pixels.
class ShownImageTest : public testing::Test {
  protected:
    ShownImageTest() {
        result.order = kOrder;
        result.document = document;
        render(result.variants[0], "caustic.irradiance", 788.4f);
        reference.photons = 8'000'000;
        reference.relativeError = 0.146;
        reference.version = 3;
        reference.aim = {document.scene, {}, document.size, {}, 0};
        reference.irradiance = std::make_shared<const Image>(filled(833.67f, 3));
    }
    static Image filled(float value, int channels) {
        Image image(4, 2, channels);
        std::fill(image.values.begin(), image.values.end(), value);
        return image;
    }
    static void render(VariantResult& variant, const std::string& name, float value,
                       const graph::TextureDesc& desc = {4, 2}) {
        variant.order = kOrder;
        ViewedTexture& viewed = variant.viewed.emplace();
        viewed.name = name;
        viewed.version = 11;
        viewed.content = contentOf(name, desc);
        viewed.place = describe(viewed.content.space);
        viewed.values = filled(value, static_cast<int>(viewed.content.channels.size()));
        viewed.origin = std::make_shared<const PictureOrigin>();
    }
    [[nodiscard]] Showing showing() const {
        return showingOf({document, kOrder, view}, result, reference);
    }

    Document document;
    ViewState view;
    FrameResult result;
    ReferenceState reference;
};

TEST_F(ShownImageTest, EachSideOfASplitHasItsOwnWordsAndNumbers) {
    view.comparedWith = ComparedImage::reference;
    const Showing both = showing();
    ASSERT_TRUE(both.main && both.compared);
    EXPECT_EQ(both.comparedProblem, "");
    EXPECT_NE(both.main->valuesAt({1, 1}).find("788.4"), std::string::npos);
    EXPECT_NE(both.compared->valuesAt({1, 1}).find("833.67"), std::string::npos);
    EXPECT_EQ(both.main->numbersAt({1, 1}).find("833"), std::string::npos);
    EXPECT_NE(both.compared->numbersAt({1, 1}).find("833.7"), std::string::npos);
    EXPECT_EQ(both.main->caption().find("reference"), std::string::npos);
    EXPECT_TRUE(both.compared->caption().starts_with("reference: caustic.irradiance"));
    // With what it is worth itself.
    EXPECT_NE(both.compared->caption().find("8 million photons, its own noise 15 %"),
              std::string::npos)
        << both.compared->caption();
    // One scale for both.
    EXPECT_EQ(both.main->mapping, both.compared->mapping);
}

TEST_F(ShownImageTest, ValuesHaveTheirNamesAndUnits) {
    const ShownImage image = *showing().main;
    EXPECT_EQ(image.valuesAt({1, 0}),
              "(1, 0)  red 788.4  green 788.4  blue 788.4 W/m²  alpha 788.4");
    EXPECT_EQ(image.valuesAt({4, 0}), "");
    EXPECT_EQ(image.caption(), "caustic.irradiance · caustic irradiance, W/m² · the eye's view");
}

TEST_F(ShownImageTest, UnlikeImagesShareNoSplit) {
    view.comparedWith = ComparedImage::reference;
    render(result.variants[0], "shadow.maps", 2.0f);
    Showing both = showing();
    EXPECT_FALSE(both.compared);
    EXPECT_NE(both.comparedProblem.find("shadow.maps is a light's view"), std::string::npos)
        << both.comparedProblem;
    render(result.variants[0], "layers.depth", 2.0f);
    both = showing();
    EXPECT_FALSE(both.compared);
    EXPECT_NE(both.comparedProblem.find("W/m²"), std::string::npos) << both.comparedProblem;
    reference.irradiance = std::make_shared<const Image>(Image(8, 2, 3));
    render(result.variants[0], "caustic.irradiance", 2.0f);
    both = showing();
    EXPECT_FALSE(both.compared);
    EXPECT_NE(both.comparedProblem.find("8×2"), std::string::npos) << both.comparedProblem;
}

TEST_F(ShownImageTest, OnlyTheEyesViewTakesWhatIsDrawnOverIt) {
    EXPECT_TRUE(showing().main->takesOverlay);
    for (const char* name : {"shadow.maps", "hits.flux_1", "around.depth", "layers.pyramid"}) {
        render(result.variants[0], name, 1.0f);
        EXPECT_FALSE(showing().main->takesOverlay) << name;
    }
}

TEST_F(ShownImageTest, AnErrorHasASignAndIsNoColourTwice) {
    view.comparedWith = ComparedImage::error;
    EXPECT_NE(showing().comparedProblem.find("still being measured"), std::string::npos);
    ReferenceState::Judgement& judgement = reference.judgements[0];
    judgement.order = kOrder;
    Image error = filled(-45.27f, 1);
    error.at(0, 0, 0) = std::nanf("");
    judgement.error = std::make_shared<const Image>(error);
    judgement.errorHistogram = histogramOf(error);
    const Showing both = showing();
    ASSERT_TRUE(both.compared);
    EXPECT_EQ(both.compared->valuesAt({1, 0}), "(1, 0)  error -45.27 W/m²");
    EXPECT_EQ(both.compared->valuesAt({0, 0}), "(0, 0)  left out");
    EXPECT_TRUE(both.compared->caption().starts_with(
        "error: caustic irradiance less the reference's, mean of the channels, W/m²"))
        << both.compared->caption();
    EXPECT_TRUE(both.compared->mapping.isFalseColor);
    EXPECT_EQ(both.compared->colorBar()->scale, Scale::symmetric);
    EXPECT_EQ(both.compared->age, "");
    judgement.order = kOrder - 1;
    EXPECT_NE(showing().compared->caption().find("of a frame before"), std::string::npos);
}

TEST_F(ShownImageTest, LooksBelongToATexture) {
    view.looks["caustic.irradiance"].isExposureAutomatic = false;
    view.looks["caustic.irradiance"].exposureStops = -3.0f;
    EXPECT_EQ(showing().main->mapping.exposureStops, -3.0f);
    // By itself what is dim is seen, too.
    render(result.variants[0], "photons.flux", 1e-6f);
    EXPECT_NEAR(showing().main->mapping.exposureStops, std::log2(1e6f), 1e-3f);
    EXPECT_NEAR(showing().main->colorBar()->high, 1e-6, 1e-12);
}

TEST_F(ShownImageTest, BarsSayWhatIsBeyondTheirEnds) {
    Look& look = view.looks["caustic.irradiance"];
    look.isFalseColor = true;
    look.isRangeAutomatic = false;
    look.low = 100.0f;
    look.high = 700.0f;
    ColorBar bar = *showing().main->colorBar();
    EXPECT_FALSE(bar.clipsLow);
    EXPECT_TRUE(bar.clipsHigh);
    EXPECT_EQ(bar.label, "luminance of caustic irradiance, W/m²");
    look.scale = Scale::logarithmic;
    look.high = 1e4f;
    bar = *showing().main->colorBar();
    EXPECT_FALSE(bar.clipsHigh);
    ASSERT_EQ(bar.ticks.size(), 3u);
    EXPECT_EQ(bar.ticks[1].label, "1000");
    EXPECT_NEAR(bar.ticks[1].place, 0.5, 1e-6);
    look.scale = Scale::symmetric;
    look.high = 500.0f;
    bar = *showing().main->colorBar();
    EXPECT_EQ(bar.low, -500.0);
    EXPECT_TRUE(bar.clipsHigh);
}

// Of a red of 1000 the luminance is 212.6.
TEST_F(ShownImageTest, FalseColoursOfAColourAreOfItsLuminanceAndSoIsAllThatSpeaksOfThem) {
    ViewedTexture& viewed = *result.variants[0].viewed;
    viewed.values = filled(0.0f, 4);
    viewed.values.at(1, 1, 0) = 1000.0f;
    EXPECT_EQ(showing().main->histogram.high, 1000.0f);
    view.looks["caustic.irradiance"].isFalseColor = true;
    const ShownImage image = *showing().main;
    EXPECT_NEAR(image.histogram.high, 212.639f, 0.01f);
    EXPECT_NE(image.caption().find("luminance of caustic irradiance, W/m²"), std::string::npos)
        << image.caption();
    view.looks["caustic.irradiance"].isRangeAutomatic = false;
    view.looks["caustic.irradiance"].high = 300.0f;
    EXPECT_FALSE(showing().main->colorBar()->clipsHigh);
    // And of one channel alone.
    view.looks["caustic.irradiance"].channel = Channel::red;
    EXPECT_EQ(showing().main->histogram.high, 1000.0f);
    EXPECT_TRUE(showing().main->colorBar()->clipsHigh);
}

TEST_F(ShownImageTest, AVectorsLengthIsNeverNegative) {
    render(result.variants[0], "photons.position", -3.0f);
    EXPECT_EQ(showing().main->histogram.low, -3.0f);
    view.looks["photons.position"].channel = Channel::luminance;
    EXPECT_NEAR(showing().main->histogram.low, std::sqrt(27.0f), 1e-5f);
}

TEST_F(ShownImageTest, WhatAPictureIsOfIsWhatItWasRenderedByAndNotWhatIsSetUp) {
    Variant planar;
    planar.technique = "planar";
    planar.assignments["emit.photons"] = "64x64";
    result.variants[0].viewed->origin =
        std::make_shared<const PictureOrigin>(PictureOrigin{"pool", planar, {4, 2}});
    document.variant.assignments["eye.samples"] = "8";
    result.document = document;
    view.comparedWith = ComparedImage::reference;
    const Showing both = showing();
    EXPECT_EQ(both.main->identity(), "pool, planar, emit.photons=64x64, 4×2 px");
    EXPECT_EQ(both.compared->identity(), "pool, 800×600 px");
    std::map<std::string, std::string> written;
    for (const auto& [key, value] : both.main->metadata())
        written[key] = value;
    EXPECT_EQ(written["technique"], "planar");
    EXPECT_EQ(written["settings"], "planar, emit.photons=64x64");
    for (const auto& [key, value] : both.compared->metadata())
        EXPECT_NE(key, "technique") << value;
    // Of a difference, both.
    ShownImage difference = *both.main;
    difference.originOfSubtrahend =
        std::make_shared<const PictureOrigin>(PictureOrigin{"pool", Variant(), {4, 2}});
    EXPECT_EQ(difference.identity(),
              "pool, planar, emit.photons=64x64, 4×2 px; less pool, exact_rays, 4×2 px");
    written.clear();
    for (const auto& [key, value] : difference.metadata())
        written[key] = value;
    EXPECT_EQ(written["technique"], "planar");
    EXPECT_EQ(written["subtrahend technique"], "exact_rays");
}

TEST_F(ShownImageTest, WholeNumbersAreWrittenWhole) {
    render(result.variants[0], "caustic.irradiance", 48895.0f);
    EXPECT_TRUE(showing().main->numbersAt({1, 1}).starts_with("48895\n"));
    render(result.variants[0], "caustic.irradiance", 1234567.0f);
    EXPECT_NE(showing().main->valuesAt({1, 1}).find("red 1234567 "), std::string::npos);
}

// The column next to the picture is as wide as they are.
TEST_F(ShownImageTest, NumbersOfABarAreShortWhateverItsRange) {
    Look& look = view.looks["caustic.irradiance"];
    look.isFalseColor = true;
    look.isRangeAutomatic = false;
    look.low = 0.0f;
    for (int exponent = -7; exponent <= 7; ++exponent) {
        look.high = static_cast<float>(5.0 * std::pow(10.0, exponent));
        const ColorBar bar = *showing().main->colorBar();
        ASSERT_GE(bar.ticks.size(), 3u);
        const ColorBar::Tick& last = bar.ticks.back();
        for (const ColorBar::Tick& tick : bar.ticks)
            EXPECT_LE(tick.label.size(), 3u) << tick.label;
        // What the label says is what the place has.
        EXPECT_NEAR(
            std::stod(last.label) * std::pow(10.0, bar.power) / static_cast<double>(look.high),
            last.place, 1e-3);
    }
    look.scale = Scale::logarithmic;
    look.low = 1e-6f;
    look.high = 1e6f;
    const ColorBar bar = *showing().main->colorBar();
    EXPECT_EQ(bar.power, 0) << "each number has its own";
    EXPECT_EQ(bar.ticks.front().label, "10⁻⁶");
    EXPECT_EQ(bar.ticks.back().label, "10⁶");
}

TEST(Look, PlacesAndValuesOnAScaleAreInverse) {
    for (const Scale scale : {Scale::linear, Scale::logarithmic, Scale::symmetric}) {
        for (const double place : {0.0, 0.3, 1.0})
            EXPECT_NEAR(placeOn(scale, 0.1, 40.0, valueOn(scale, 0.1, 40.0, place)), place, 1e-12);
    }
    EXPECT_LT(placeOn(Scale::logarithmic, 0.1, 40.0, -1.0), 0.0);
}

// Grey as people see it without one kind of cones is still ordered, which lightness guarantees.
TEST(Look, ColoursRiseInLightness) {
    const auto lightness = [](Scale scale, double t) {
        const std::array<float, 3> c = falseColor(scale, t);
        return 0.2126 * std::pow(c[0], 2.2) + 0.7152 * std::pow(c[1], 2.2) +
               0.0722 * std::pow(c[2], 2.2);
    };
    for (int i = 0; i < 50; ++i) {
        EXPECT_LT(lightness(Scale::linear, i / 50.0), lightness(Scale::linear, (i + 1) / 50.0));
        EXPECT_LT(lightness(Scale::symmetric, i / 100.0),
                  lightness(Scale::symmetric, (i + 1) / 100.0));
        EXPECT_LT(lightness(Scale::symmetric, 1.0 - i / 100.0),
                  lightness(Scale::symmetric, 1.0 - (i + 1) / 100.0));
    }
}

TEST(TextureContent, IsKnownByNameWhateverListOrLightItIsOf) {
    const graph::TextureDesc four{8, 8, graph::Format::rgba32f, 0};
    EXPECT_EQ(contentOf("photons.flux_3.medium.probes", four).unit(), "W");
    EXPECT_EQ(contentOf("hits.position_shadow_0", four).channels[3].unit, "m");
    EXPECT_EQ(contentOf("around.cube_2.depth", four).space, TextureSpace::cube);
    EXPECT_EQ(contentOf("caustic.filtered.cube_4", four).unit(), "W");
    EXPECT_EQ(contentOf("deferred.depth.light_2", {8, 8, graph::Format::rg32f, 0}).channels.size(),
              2u);
    EXPECT_EQ(contentOf("caustic.irradiance", four).space, TextureSpace::eye);
    EXPECT_EQ(contentOf("hits.flux", four).space, TextureSpace::list);
    EXPECT_FALSE(contentOf("mine.values", four).isKnown);
    EXPECT_EQ(contentOf("mine.values", four).channels.size(), 4u);
}

TEST(TextureReader, SumsOfTwoWordsAreLight) {
    std::vector<Image> words(6, Image(1, 1, 1));
    words[0].values[0] = 5.0f;  // red: 2 * 2^32 + 5
    words[1].values[0] = 2.0f;
    words[4].values[0] = 7.0f;  // blue
    const Image light = lightOfSums(words, 0.5);
    EXPECT_FLOAT_EQ(light.at(0, 0, 0), static_cast<float>((2.0 * 4294967296.0 + 5.0) * 0.5));
    EXPECT_EQ(light.at(0, 0, 1), 0.0f);
    EXPECT_EQ(light.at(0, 0, 2), 3.5f);
}

// Across an edge that two faces of the cross share, the directions go on.
TEST(TextureReader, FacesOfACrossFitTogether) {
    constexpr int kSide = 16;
    std::vector<Image> faces;
    for (int face = 0; face < 6; ++face) {
        const render::RasterView view = render::makeCubeFaceView(glm::dvec3(0.0), face);
        Image& image = faces.emplace_back(kSide, kSide, 3);
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const glm::dvec3 inView(2.0 * (x + 0.5) / kSide - 1.0,
                                        1.0 - 2.0 * (y + 0.5) / kSide, -1.0);
                const glm::dvec3 direction =
                    glm::normalize(glm::inverse(glm::dmat3(view.worldToView)) * inView);
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) = static_cast<float>(direction[c]);
            }
        }
    }
    const Image cross = unfoldCube(faces);
    ASSERT_EQ(cross.width, 4 * kSide);
    ASSERT_EQ(cross.height, 3 * kSide);
    const auto direction = [&](int x, int y) {
        if (x >= cross.width || y >= cross.height) return glm::vec3(0.0f);
        return glm::vec3(cross.at(x, y, 0), cross.at(x, y, 1), cross.at(x, y, 2));
    };
    int joined = 0;
    for (int y = 0; y < cross.height; ++y) {
        for (int x = 0; x < cross.width; ++x) {
            const glm::vec3 here = direction(x, y);
            for (const glm::vec3 next : {direction(x + 1, y), direction(x, y + 1)}) {
                if (glm::length(here) == 0.0f || glm::length(next) == 0.0f) continue;
                // A texel is 2/16 wide at most.
                EXPECT_LT(glm::length(next - here), 2.0f / kSide + 1e-4f) << x << ", " << y;
                ++joined;
            }
        }
    }
    // Within the faces, and across the five edges of a cube's net.
    EXPECT_EQ(joined, 6 * 2 * kSide * (kSide - 1) + 5 * kSide);
    EXPECT_EQ(regionsOfCube(kSide).size(), 6u);
}

}  // namespace
}  // namespace kaustik::gui::test
