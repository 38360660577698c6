// SPDX-License-Identifier: MIT
// A desktop and a folder for each test, and a workbench on it that begins with a scene and settings
// of which a frame is rendered in no time, as if it had been left so the last time.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/gui/desktop.h"
#include "tests/gui/workbench_process.h"

namespace kaustik::test {

class WorkbenchTest : public testing::Test {
  protected:
    using Json = nlohmann::json;

    // On a desktop of that size, pixels.
    explicit WorkbenchTest(int desktopWidth = 1440, int desktopHeight = 900);

    // 64x48 pixels of that scene, by default the wavy water, with 32x32 photons.
    [[nodiscard]] static Json smallDocument(const std::string& scene = "wavy.toml");
    // What the workbench keeps, with that document: without handles of lights on the picture, and
    // recordings go to the folder "out", reports without a reference.
    [[nodiscard]] static Json savedStateWith(const Json& document);
    // The same with the small document, and a texture in the picture's place.
    [[nodiscard]] static Json savedStateShowing(const std::string& resource, int layer = 0);
    void writeSavedState(const Json& kept) const;
    [[nodiscard]] Json readSavedState() const;

    // Starts it with what was written, and waits until the first picture is settled.
    void start(const Json& kept = savedStateWith(smallDocument()),
               const std::map<std::string, std::string>& environment = {});
    // The same, with what it kept itself.
    void startAgain(const std::map<std::string, std::string>& environment = {});
    void endByClosing();

    void untilSettled();
    void untilRecorded();
    // Comes by a tab's name: Passes, Technique, Scene, Parameters, Image, Error, Record.
    void open(const std::string& tab) { bench->click("tab." + tab); }
    // Switches a pass off or on in the panel Passes, which has more rows than it shows.
    void switchPass(const std::string& name);
    void choose(const std::string& control, const std::string& option);
    [[nodiscard]] Json document() { return bench->status().at("document"); }
    [[nodiscard]] bool says(const std::string& control, const std::string& part);

    // A spot of "picture.image": the middle of a pixel of the picture.
    [[nodiscard]] Spot pixel(int x, int y) const;
    // What is seen of the picture, without the mouse on it.
    [[nodiscard]] Image seenPicture();

    // `kaustik` with the workbench's cache, in its folder.
    Outcome run(const std::vector<std::string>& arguments) const;
    // `kaustik run` of the small document's scene and settings, then `more`.
    Outcome renderSmall(const std::vector<std::string>& more,
                        const std::string& scene = "wavy.toml") const;
    [[nodiscard]] Json readJson(const std::filesystem::path& file) const;

    int width = 64;  // of the picture
    int height = 48;
    TemporaryFolder folder;
    Desktop desktop;
    std::optional<WorkbenchProcess> bench;
};

// The mean of all values.
[[nodiscard]] double meanOf(const Image& image);
// The largest difference of a value; infinite between images of different sizes.
[[nodiscard]] double largestDifference(const Image& a, const Image& b);
// Columns from `x0` up to `x1`.
[[nodiscard]] Image columns(const Image& image, int x0, int x1);

}  // namespace kaustik::test
