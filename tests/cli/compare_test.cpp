// SPDX-License-Identifier: MIT
// kaustik compare: figures that can be worked out by hand, and what it refuses.
#include <cmath>
#include <limits>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Compare : public CommandLine {
  protected:
    // 32x32 pixels of one value, then those of `dots` set to another.
    void write(const std::string& name, float value, float dot = 0.0f, int dots = 0) const {
        Image image(32, 32, 3);
        std::fill(image.values.begin(), image.values.end(), value);
        for (int i = 0; i < dots; ++i) {
            for (int c = 0; c < 3; ++c)
                image.at(i % 32, i / 32, c) = dot;
        }
        writeImage(folder / name, image);
    }
    [[nodiscard]] json errors(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"compare", "image.exr", "reference.exr", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return json::parse(outcome.out).at("error");
    }
};

TEST_F(Compare, GivesFiguresThatCanBeWorkedOutByHand) {
    write("reference.exr", 2.0f);
    write("image.exr", 2.5f);
    const json error = errors();
    EXPECT_NEAR(error.at("rmse").get<double>(), 0.5, 1e-9);
    EXPECT_NEAR(error.at("mae").get<double>(), 0.5, 1e-9);
    EXPECT_NEAR(error.at("energy_ratio").get<double>(), 1.25, 1e-9);
    const double epsilon = error.at("formulas").at("rel_mse").at("epsilon").get<double>();
    EXPECT_NEAR(error.at("rel_mse").get<double>(), 0.25 / (4.0 + epsilon), 1e-9);
    EXPECT_NEAR(error.at("smape").get<double>(), 0.5 / 4.5, 1e-9);
    const std::string table = run({"compare", "image.exr", "reference.exr"}).out;
    for (const char* name : {"RMSE", "relMSE", "SMAPE", "energy ratio"})
        EXPECT_NE(table.find(name), std::string::npos) << name;
}

TEST_F(Compare, OfAnImageWithItselfIsPerfect) {
    write("reference.exr", 1.0f, 3.0f, 100);
    write("image.exr", 1.0f, 3.0f, 100);
    const json error = errors();
    for (const char* key : {"rmse", "mae", "rel_mse", "smape", "flip_ldr", "flip_hdr"})
        EXPECT_NEAR(error.at(key).get<double>(), 0.0, 1e-12) << key;
    for (const char* key : {"ssim", "energy_ratio", "encircled_energy_radius_ratio"})
        EXPECT_NEAR(error.at(key).get<double>(), 1.0, 1e-9) << key;
}

TEST_F(Compare, CountsOnlyWhatTheMaskLeavesAndWeighsByArea) {
    write("reference.exr", 1.0f);
    write("image.exr", 1.0f, 5.0f, 512);  // the upper half is wrong
    write("mask.exr", 1.0f, 0.0f, 512);
    write("area.exr", 1.0f, 3.0f, 512);
    EXPECT_NEAR(errors({"--mask", "mask.exr"}).at("rmse").get<double>(), 0.0, 1e-12);
    // (3 * 5 + 1) / (3 + 1)
    EXPECT_NEAR(errors({"--area", "area.exr"}).at("energy_ratio").get<double>(), 4.0, 1e-6);
}

TEST_F(Compare, SaysWhatTheReferencesOwnErrorWouldGive) {
    write("reference.exr", 1.0f);
    write("image.exr", 1.0f);
    write("noise.exr", 0.125f);
    const json noise = errors({"--stderr", "noise.exr"}).at("truth_noise");
    EXPECT_NEAR(noise.at("rmse").get<double>(), 0.125, 1e-9);
}

TEST_F(Compare, DrawsAHeatMap) {
    write("reference.exr", 1.0f);
    write("image.exr", 1.0f, 5.0f, 512);
    const Outcome outcome = run({"compare", "image.exr", "reference.exr", "--heatmap", "map.png"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Image map = readImage(folder / "map.png");
    EXPECT_GT(map.at(5, 2, 0), map.at(5, 30, 0) + 0.5f);
    expectFailure(run({"compare", "image.exr", "reference.exr", "--heatmap", "map.txt"}), 2,
                  {"map.txt", ".png"});
    expectFailure(run({"compare", "map.png", "map.png", "--heatmap", "map.png"}), 2, {"map.png"});
}

TEST_F(Compare, TakesTheViewersDistance) {
    write("reference.exr", 1.0f);
    write("image.exr", 1.0f, 0.2f, 3);
    const double close = errors({"--ppd", "10"}).at("flip_ldr").get<double>();
    const double distant = errors({"--ppd", "120"}).at("flip_ldr").get<double>();
    EXPECT_NE(close, distant);
    expectFailure(run({"compare", "image.exr", "reference.exr", "--ppd", "0"}), 2, {"--ppd"});
}

TEST_F(Compare, RefusesImagesThatHoldNoNumbersByName) {
    write("reference.exr", 1.0f);
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        write("image.exr", 1.0f, value, 1);
        expectFailure(run({"compare", "image.exr", "reference.exr"}), 1, {"image.exr"});
        expectFailure(run({"compare", "reference.exr", "image.exr"}), 1, {"image.exr"});
    }
}

TEST_F(Compare, RefusesWhatDoesNotBelongTogether) {
    write("reference.exr", 1.0f);
    Image small(16, 32, 3);
    writeImage(folder / "small.exr", small);
    expectFailure(run({"compare", "small.exr", "reference.exr"}), 2,
                  {"small.exr", "16x32", "32x32"});
    expectFailure(run({"compare", "reference.exr", "nowhere.exr"}), 1, {"nowhere.exr"});
    expectFailure(run({"compare", "reference.exr"}), 2, {"reference"});
    expectFailure(run({"compare", "reference.exr", "reference.exr", "--heatmp", "x.png"}), 2,
                  {"--heatmp", "--heatmap", "kaustik compare --help"});
    static_cast<void>(folder.file("text.exr", "no image"));
    expectFailure(run({"compare", "text.exr", "reference.exr"}), 1, {"text.exr"});
}

}  // namespace
}  // namespace kaustik::test
