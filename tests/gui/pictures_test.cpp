// SPDX-License-Identifier: MIT
// Scenes and techniques chosen by their pictures, which are made once.
#include <algorithm>

#include "framework/image/image.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Pictures : public WorkbenchTest {
  protected:
    // The first of `control`'s pictures that is there, but for `current`; waits for one.
    [[nodiscard]] std::string firstThere(const std::string& control, const std::string& current) {
        std::string found;
        bench->waitFor("a picture", [&](const json& screen) {
            for (const auto& [name, rectangle] : screen.at("controls").items()) {
                if (!name.starts_with(control + "=") || rectangle.at("value") != "there") continue;
                found = name.substr(control.size() + 1);
                if (found != current) return true;
            }
            return false;
        });
        return found;
    }
    [[nodiscard]] std::vector<fs::path> cached() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder / "cache/thumbnails")) {
            if (entry.path().filename().string().front() != '.') files.push_back(entry.path());
        }
        return files;
    }
};

TEST_F(Pictures, ASceneIsChosenByItsPictureAndThePictureIsKept) {
    start();
    open("Scene");
    bench->click("scene.pictures");
    const std::string scene = firstThere("scene.pictures", "");
    bench->keepScreenshot("pictures-scenes");
    ASSERT_FALSE(cached().empty());
    const Image picture = readImage(cached().front());
    EXPECT_EQ(picture.width, 160);
    EXPECT_EQ(picture.height, 120);
    const auto [darkest, brightest] =
        std::minmax_element(picture.values.begin(), picture.values.end());
    EXPECT_GT(*brightest, *darkest + 0.1f);
    bench->click("scene.pictures=" + scene);
    untilSettled();
    EXPECT_EQ(bench->status().at("scene"), scene);
    EXPECT_FALSE(bench->has("scene.pictures=" + scene)) << "the choice is over";

    // The next time it is read.
    const fs::path file = cached().front();
    const auto written = fs::last_write_time(file);
    endByClosing();
    startAgain();
    open("Scene");
    bench->click("scene.pictures");
    static_cast<void>(firstThere("scene.pictures", ""));
    EXPECT_EQ(fs::last_write_time(file), written);
    bench->key("Escape");
    bench->waitFor("the end of the choice", [&](const json& screen) {
        return !screen.at("controls").contains("scene.pictures=" + scene);
    });
    EXPECT_EQ(bench->status().at("scene"), scene);
}

TEST_F(Pictures, ATechniqueIsChosenByItsPictureOfTheScene) {
    start();
    open("Technique");
    bench->click("technique.pictures");
    const std::string technique = firstThere("technique.pictures", "screen_space_photons");
    bench->keepScreenshot("pictures-techniques");
    bench->click("technique.pictures=" + technique);
    untilSettled();
    EXPECT_EQ(document().at("variant").at("technique"), technique);
    EXPECT_EQ(document().at("variant").at("set").at("emit.photons"), "32x32");
}

}  // namespace
}  // namespace kaustik::test
