// SPDX-License-Identifier: MIT
// Variants that are kept, flipped to and compared; and the room that the picture has.
#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "framework/image/image.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class ComparePanel : public WorkbenchTest {
  protected:
    void startWith(const std::string& resource) {
        json kept = savedStateWith(smallDocument());
        kept["view"]["resource"] = resource;
        start(kept);
    }
    [[nodiscard]] double redAt(int x, int y) {
        bench->hover("picture.image", pixel(x, y));
        const std::string text = bench->value("picture.value");
        return std::stod(text.substr(text.find("red ") + 4));
    }
};

TEST_F(ComparePanel, WhatIsKeptIsFlippedToAndTakenOffWithoutRenderingAgain) {
    startWith("caustic.irradiance");
    const double before = redAt(38, 27);
    bench->key("k");
    EXPECT_TRUE(says("status.message", "Kept as 1: screen_space_photons"));
    bench->typeInto("parameter.emit.photons", "16", Entry::click, "Return", {0.2, 0.5});
    untilSettled();
    const double after = redAt(38, 27);
    ASSERT_NE(before, after);
    const json order = bench->status().at("order");
    bench->hover("picture");
    bench->key("1");
    EXPECT_TRUE(bench->value("picture.caption").starts_with("kept 1: caustic.irradiance"));
    EXPECT_TRUE(says("shown.sentence", "Kept variant 1"));
    EXPECT_EQ(redAt(38, 27), before);
    bench->key("1");
    EXPECT_EQ(redAt(38, 27), after);
    EXPECT_FALSE(says("picture.caption", "kept"));
    open("Compare");
    bench->click("compare.1.difference");
    bench->waitFor("the difference", [](const json& screen) {
        return screen.at("controls").contains("picture.caption.compared");
    });
    EXPECT_TRUE(says("picture.caption.compared", "minus kept 1"));
    EXPECT_TRUE(says("picture.caption.compared", "RMSE"));
    bench->hover("picture.image", pixel(38, 27));
    const std::string text = bench->value("picture.value");
    // White light: all channels differ by the same.
    EXPECT_NEAR(std::stod(text.substr(text.find("difference ") + 11)), after - before,
                1e-3 * std::abs(after) + 1e-3)
        << text;
    EXPECT_EQ(bench->status().at("order"), order) << "nothing was rendered for it";
    bench->keepScreenshot("compare-difference");
    bench->click("compare.pairs");
    bench->waitFor("the pairs", [](const json& screen) {
        return screen.at("controls").contains("compare.pair.A-1");
    });
    EXPECT_GT(std::stod(bench->value("compare.pair.A-1")), 0.0);
    bench->click("compare.1.settings");
    untilSettled();
    EXPECT_EQ(document().at("variant").at("set").at("emit.photons"), "32x32");
    bench->click("compare.1.forget");
    EXPECT_FALSE(bench->has("compare.1"));
}

class ThePicture : public WorkbenchTest {
  protected:
    ThePicture() : WorkbenchTest(1600, 1000) {}
    [[nodiscard]] double share() {
        const Rectangle pane = bench->control("picture.pane");
        return pane.w * pane.h / (windowWidth * windowHeight);
    }
    // Without its caption and the colour bar.
    [[nodiscard]] double shareOfPixels() {
        const Rectangle pixels = bench->control("picture");
        return pixels.w * pixels.h / (windowWidth * windowHeight);
    }
    void startAt(int w, int h, const json& panels = json::object()) {
        json kept = savedStateWith(smallDocument());
        kept["panels"] = panels;
        kept["panels"]["precise"] = true;
        kept["window"] = {{"width", w}, {"height", h}, {"x", 0}, {"y", 0}};
        windowWidth = w;
        windowHeight = h;
        start(kept);
    }
    double windowWidth = 1.0;
    double windowHeight = 1.0;
};

// A line below the picture speaks of what is there, and goes with it.
TEST_F(ComparePanel, AMessageGoesWithWhatItSpeaksOf) {
    start();
    open("Compare");
    bench->key("3");
    EXPECT_TRUE(says("status.message", "There is no kept variant 3"));
    bench->key("k");
    EXPECT_TRUE(says("status.message", "Kept as 1: "));
    bench->click("compare.1.forget");
    EXPECT_EQ(bench->status().at("message"), "");
    // What was refused is of no interest once the user has gone on.
    bench->dropFiles({folder.file("notes.txt", "x")}, "picture");
    EXPECT_TRUE(says("status.message", "is neither a scene"));
    bench->drag("picture", 30, 0);
    EXPECT_EQ(bench->status().at("message"), "");
}

// As the workbench first starts, and with a colour bar next to it, of a unit or of none.
TEST_F(ThePicture, HasThreeQuartersOfAWindowAndSixTenthsOfASmallOneWithItsBarToo) {
    for (const auto& [w, h, part] : {std::tuple{1024, 768, 0.6}, std::tuple{1600, 1000, 0.75}}) {
        startAt(w, h);
        EXPECT_GE(shareOfPixels(), part);
        for (const char* texture : {"picture", "caustic.irradiance"}) {
            open("Image");
            choose("image.texture", texture);
            untilSettled();
            bench->hover("picture");
            if (!bench->has("picture.bar")) bench->key("f");
            bench->waitFor("a colour bar", [](const json& screen) {
                return screen.at("controls").contains("picture.bar");
            });
            EXPECT_GE(shareOfPixels(), part)
                << texture << ' ' << bench->value("picture.bar.numbers");
            // The bar stands next to the pixels and within the pane.
            const Rectangle bar = bench->control("picture.bar");
            const Rectangle pixels = bench->control("picture");
            const Rectangle pane = bench->control("picture.pane");
            EXPECT_GE(bar.x, pixels.x + pixels.w);
            EXPECT_LE(bar.x + bar.w, pane.x + pane.w);
            bench->keepScreenshot(fmt::format("bar-{}-{}", w, texture));
        }
    }
}

TEST_F(ThePicture, HasTheRoomThatPanelsLeaveAndPanelsAreRemembered) {
    startAt(1024, 768);
    EXPECT_GE(share(), 0.65);
    EXPECT_GE(shareOfPixels(), 0.6);
    ASSERT_TRUE(bench->has("tab.Passes"));
    bench->hover("picture");
    bench->key("h");
    EXPECT_GE(share(), 0.9);
    EXPECT_FALSE(bench->has("tab.Passes"));
    bench->key("h");
    open("Image");
    bench->click("panel.to_left");
    EXPECT_TRUE(bench->has("panel.to_right"));
    EXPECT_LT(bench->control("tab.Image").x, bench->control("picture.pane").x);
    EXPECT_GT(bench->control("tab.Error").x, bench->control("picture.pane").x);
    bench->key("F4");
    EXPECT_TRUE(bench->has("chart"));
    open("Error");
    endByClosing();
    startAgain();
    EXPECT_TRUE(bench->has("chart"));
    EXPECT_EQ(bench->value("tab.Image"), "open");
    EXPECT_EQ(bench->value("tab.Error"), "open");
    EXPECT_LT(bench->control("tab.Image").x, bench->control("picture.pane").x);
}

}  // namespace
}  // namespace kaustik::test
