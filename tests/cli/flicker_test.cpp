// SPDX-License-Identifier: MIT
// error.flicker of the report: how much the caustic changes between the last two of several times.
#include <cmath>
#include <filesystem>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Flicker : public CommandLine {
  protected:
    Flicker() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }

    [[nodiscard]] Outcome runCached(const std::vector<std::string>& arguments) const {
        Conditions conditions;
        conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
        Outcome outcome = run(arguments, conditions);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome;
    }
    // Four batches of photons for each reference.
    [[nodiscard]] Outcome render(const std::string& scene, const std::vector<std::string>& more,
                                 const std::string& out = "out") const {
        std::vector<std::string> arguments = {"run",
                                              scene,
                                              "--size",
                                              "64x48",
                                              "--warmup",
                                              "0",
                                              "--set",
                                              "photons=64x64",
                                              "--set",
                                              "shadow.map.size=64",
                                              "--reference-photons",
                                              "1000000",
                                              "--out",
                                              out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runCached(arguments);
    }
    [[nodiscard]] Image image(const std::string& file) const { return readImage(folder / file); }
};

// The mean of the squared difference of two images over pixels with a receiver, less that of the
// squares of `errors`.
double meanSquaredChange(const Image& from, const Image& to, const Image& receiver,
                         const std::vector<Image>& errors = {}) {
    double sum = 0.0;
    double count = 0.0;
    const auto square = [](float value) { return std::pow(static_cast<double>(value), 2.0); };
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            if (receiver.at(x, y, 0) <= 0.0f) continue;
            for (int c = 0; c < 3; ++c) {
                sum += square(to.at(x, y, c) - from.at(x, y, c));
                for (const Image& error : errors)
                    sum -= square(error.at(x, y, c));
                count += 1.0;
            }
        }
    }
    return sum / count;
}

// Against frames and references of either time that were made apart.
TEST_F(Flicker, IsTheChangeBetweenTheLastTwoTimesBesideTheTruths) {
    const Outcome outcome = render("wavy.toml", {"--frames", "3", "--time", "1", "--time-step",
                                                 "0.05", "--reference", "auto"});
    const json flicker = report().at("error").at("flicker");
    std::set<std::string> keys;
    for (const auto& [key, value] : flicker.items())
        keys.insert(key);
    EXPECT_EQ(keys, (std::set<std::string>{"rms_w_m2", "truth_rms_w_m2", "difference_w_m2",
                                           "truth_stderr_w_m2", "counted_pixels", "of_times_s"}));
    EXPECT_NEAR(flicker.at("of_times_s").at(0).get<double>(), 1.05, 1e-12);
    EXPECT_NEAR(flicker.at("of_times_s").at(1).get<double>(), 1.1, 1e-12);
    EXPECT_NE(outcome.out.find("flicker                 RMS change "), std::string::npos)
        << outcome.out;

    static_cast<void>(render("wavy.toml", {"--frames", "1", "--time", "1.05"}, "earlier"));
    static_cast<void>(
        render("wavy.toml", {"--frames", "1", "--time", "1.1", "--save", "eye.receiver"}, "later"));
    const Image receiver = image("later/eye.receiver.exr");
    const double rms = flicker.at("rms_w_m2");
    const double expected = std::sqrt(
        meanSquaredChange(image("earlier/caustic.exr"), image("later/caustic.exr"), receiver));
    EXPECT_GT(expected, 10.0);
    EXPECT_NEAR(rms, expected, 1e-6 * expected);

    // The earlier truth has a seed of its own, so that its noise is.
    static_cast<void>(runCached({"reference", "wavy.toml", "--size", "64x48", "--photons",
                                 "1000000", "--time", "1.05", "--seed", "2", "--out", "a.exr"}));
    static_cast<void>(runCached({"reference", "wavy.toml", "--size", "64x48", "--photons",
                                 "1000000", "--time", "1.1", "--out", "b.exr"}));
    const double truth = std::sqrt(meanSquaredChange(
        image("a.exr"), image("b.exr"), receiver, {image("a.stderr.exr"), image("b.stderr.exr")}));
    const double truthRms = flicker.at("truth_rms_w_m2");
    EXPECT_NEAR(truthRms, truth, 1e-5 * truth);
    EXPECT_NEAR(flicker.at("difference_w_m2").get<double>(), rms - truthRms, 1e-9 * rms);
    const double standardError = flicker.at("truth_stderr_w_m2");
    EXPECT_GT(standardError, 0.0);
    EXPECT_LT(standardError, 0.1 * truth);
    // What is judged follows the light: it cannot change by half as much or twice as much.
    EXPECT_NEAR(rms / truth, 1.0, 0.5);
}

// The filter's second frame is the mean of both: half of the change. The picture's own frame, which
// repeats the last time, would make it two thirds.
TEST_F(Flicker, IsOfTheTimedFramesWhereFramesRememberThoseBefore) {
    const std::vector<std::string> twoTimes = {"--frames", "2",           "--time-step",
                                               "0.05",     "--reference", "auto"};
    static_cast<void>(render("wavy.toml", twoTimes));
    const double alone = report().at("error").at("flicker").at("rms_w_m2");
    std::vector<std::string> filtered = twoTimes;
    filtered.insert(filtered.end(), {"--set", "temporal=reproject"});
    static_cast<void>(render("wavy.toml", filtered, "filtered"));
    const double half = report("filtered").at("error").at("flicker").at("rms_w_m2");
    EXPECT_NEAR(half, 0.5 * alone, 1e-5 * alone);
}

TEST_F(Flicker, HasAReasonWhereItCannotBeTold) {
    const auto reasonAfter = [&](const std::vector<std::string>& more) {
        static_cast<void>(render("wavy.toml", more));
        const json error = report().at("error");
        EXPECT_TRUE(error.at("flicker").is_null());
        return error.at("reasons").at("flicker").get<std::string>();
    };
    EXPECT_NE(reasonAfter({"--frames", "1", "--time-step", "0.05", "--reference", "auto"})
                  .find("all frames are of one time"),
              std::string::npos);
    static_cast<void>(runCached({"reference", "wavy.toml", "--size", "64x48", "--photons",
                                 "1000000", "--time", "0.05", "--out", "file.exr"}));
    EXPECT_NE(reasonAfter({"--frames", "2", "--time-step", "0.05", "--reference", "file.exr"})
                  .find("a reference from a file is of one time"),
              std::string::npos);
}

TEST_F(Flicker, IsAbsentWhereNothingMoves) {
    static_cast<void>(render("wavy.toml", {"--frames", "2", "--reference", "auto"}));
    EXPECT_FALSE(report().at("error").contains("flicker"));
    const Outcome still = render(
        "flat-water", {"--frames", "2", "--time-step", "0.05", "--reference", "auto"}, "still");
    EXPECT_FALSE(report("still").at("error").contains("flicker"));
    EXPECT_NE(still.out.find("--time-step 0.05 has no effect"), std::string::npos) << still.out;
}

}  // namespace
}  // namespace kaustik::test
