// SPDX-License-Identifier: MIT
// kaustik reference, and kaustik run --reference: what they give, what they keep, what they refuse.
#include <signal.h>
#include <sys/mount.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Reference : public CommandLine {
  protected:
    Reference() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }

    // With a cache of the test's own.
    [[nodiscard]] Outcome runCached(const std::vector<std::string>& arguments) const {
        return run(arguments, conditions());
    }
    [[nodiscard]] Conditions conditions() const {
        Conditions conditions;
        conditions.folder = folder / ".";
        conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()}};
        return conditions;
    }

    // Four batches: enough for an error, and little to compute.
    [[nodiscard]] Outcome makeReference(const std::vector<std::string>& more = {},
                                        const std::string& file = "reference.exr") const {
        std::vector<std::string> arguments = {"reference", "wavy.toml", "--size", "64x48",
                                              "--photons", "1000000",   "--out",  file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runCached(arguments);
    }
    [[nodiscard]] Outcome runAgainst(const std::string& reference,
                                     const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments =
            smallRun("wavy.toml",
                     {"--out", "out", "--reference", reference, "--reference-photons", "1000000"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runCached(arguments);
    }

    // What the cache holds of the last run's reference.
    [[nodiscard]] fs::path cached(const std::string& extension) const {
        const std::string key = report().at("error").at("reference_key");
        return folder / ("cache/references/" + key + extension);
    }
};

TEST_F(Reference, IsAnImageItsErrorAndWhatTheyAre) {
    const Outcome outcome = makeReference();
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("standard error"), std::string::npos);
    const Image reference = readImage(folder / "reference.exr");
    EXPECT_EQ(reference.width, 64);
    EXPECT_EQ(reference.height, 48);
    EXPECT_EQ(readImage(folder / "reference.stderr.exr").width, 64);
    const json sidecar = json::parse(contents("reference.json"));
    EXPECT_EQ(sidecar.at("scene"), "wavy");
    EXPECT_GE(sidecar.at("photons").get<double>(), 1e6);
    EXPECT_LT(std::abs(sidecar.at("energy").at("balance").get<double>()), 1e-9);
}

TEST_F(Reference, IsTheSameForASeedAtAnyNumberOfThreads) {
    ASSERT_EQ(makeReference({"--threads", "1"}, "one.exr").exitCode, 0);
    fs::remove_all(folder / "cache");
    ASSERT_EQ(makeReference({"--threads", "8"}, "eight.exr").exitCode, 0);
    EXPECT_EQ(readImage(folder / "one.exr").values, readImage(folder / "eight.exr").values);
}

TEST_F(Reference, JudgesWhatTheEyeSeesThroughSpecularSurfacesApart) {
    const Outcome outcome = runAgainst("auto");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("exit direction median"), std::string::npos) << outcome.out;
    const json view = report().at("error").at("view");
    // One interface, which the eye sees itself: rounding is all that is wrong.
    EXPECT_EQ(view.at("interfaces_right"), 1.0);
    EXPECT_EQ(view.at("lost"), 0.0);
    EXPECT_LT(view.at("exit_direction_deg").at("p99").get<double>(), 0.01);
    EXPECT_LT(view.at("exit_position_px").at("median").get<double>(), 1e-3);
    EXPECT_GT(view.at("radiance").at("ssim").get<double>(), 0.5);
    EXPECT_EQ(readImage(folder / "out/view_error.png").width, report().at("size").at(0));
    EXPECT_TRUE(fs::exists(folder / "out/view_reference.exr"));
    // A node that looks no farther than the first interface.
    ASSERT_EQ(runAgainst("auto", {"--set", "view=interface"}).exitCode, 0);
    const json other = report().at("error").at("view");
    EXPECT_EQ(other.at("interfaces_right"), 1.0);
    EXPECT_LT(other.at("exit_direction_deg").at("p99").get<double>(), 0.01);
    EXPECT_GT(other.at("radiance").at("rmse").get<double>(), 0.0);
    // A pass that is switched off follows no rays.
    ASSERT_EQ(runAgainst("auto", {"--disable", "view.bvh"}).exitCode, 0);
    EXPECT_EQ(report().at("error").at("view").at("lost"), 1.0);
}

TEST_F(Reference, StopsAtATimeOrAnError) {
    ASSERT_EQ(
        runCached({"reference", "wavy.toml", "--size", "16x12", "--error", "0.2", "--out", "a.exr"})
            .exitCode,
        0);
    EXPECT_LE(json::parse(contents("a.json")).at("relative_stderr").get<double>(), 0.2);
    // Stops after the batch during which the time ran out; two are the least. The photons would
    // take any machine years.
    ASSERT_EQ(runCached({"reference", "wavy.toml", "--size", "16x12", "--seed", "2", "--photons",
                         "1000000000000000", "--seconds", "1", "--out", "b.exr"})
                  .exitCode,
              0);
    EXPECT_GE(json::parse(contents("b.json")).at("batches").get<int>(), 2);
    EXPECT_LT(json::parse(contents("b.json")).at("photons").get<double>(), 1e15);
}

TEST_F(Reference, OfFewerPhotonsThanABatchHasTwoBatchesFromTheFirstTimeOn) {
    for (int time = 1; time <= 2; ++time) {
        const Outcome outcome = runCached(
            {"reference", "wavy.toml", "--size", "16x12", "--photons", "1000", "--out", "few.exr"});
        EXPECT_EQ(outcome.exitCode, 0) << "time " << time << ": " << outcome.err;
        EXPECT_EQ(json::parse(contents("few.json")).at("batches"), 2);
    }
    const Outcome outcome = runCached({"reference", "wavy.toml", "--size", "16x12", "--seed", "2",
                                       "--seconds", "1e-9", "--out", "short.exr"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(json::parse(contents("short.json")).at("batches"), 2);
}

TEST_F(Reference, ThatNoPixelSeesIsGivenUpWhereOnlyAnErrorWouldEndIt) {
    std::string away = kWavyWater;
    away.insert(away.find("position = [0, 2, 1]"), "target = [0, 4, 2]\n");
    static_cast<void>(folder.file("away.toml", away));
    const Outcome outcome = runCached(
        {"reference", "away.toml", "--size", "16x12", "--error", "0.1", "--out", "a.exr"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("no pixel is lit"), std::string::npos);
    EXPECT_TRUE(json::parse(contents("a.json")).at("relative_stderr").is_null());
}

TEST_F(Reference, BySppmAgreesWithTheOther) {
    ASSERT_EQ(makeReference({}, "light.exr").exitCode, 0);
    ASSERT_EQ(makeReference({"--estimator", "sppm"}, "sppm.exr").exitCode, 0);
    const auto fluxOf = [&](const char* file) {
        double sum = 0.0;
        for (const float value : readImage(folder / file).values)
            sum += static_cast<double>(value);
        return sum;
    };
    // A million photons over 3,072 pixels; radii of pixels blur across the water's shadow.
    EXPECT_NEAR(fluxOf("sppm.exr") / fluxOf("light.exr"), 1.0, 0.02);
}

TEST_F(Reference, OfARunGivesHitsAndErrors) {
    const Outcome outcome = runAgainst("auto");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("agreement"), std::string::npos);
    const json result = report();
    const json& hits = result.at("hits");
    for (const char* key : {"agreement", "agreement_visible", "median_m", "p95_m", "p99_m", "max_m",
                            "median_px", "p99_px"}) {
        EXPECT_TRUE(hits.at(key).is_number()) << key;
    }
    for (const char* cause : {"off_screen", "behind_eye", "beyond_layers", "edge_on", "tracer"})
        EXPECT_TRUE(hits.at("missed").at(cause).is_number()) << cause;
    EXPECT_GT(hits.at("agreement_visible").get<double>(), 0.9);
    const json& error = result.at("error");
    EXPECT_EQ(error.at("reference"), "auto");
    EXPECT_GT(error.at("reference_stderr").get<double>(), 0.0);
    for (const json* of : {&error, &error.at("modelled_paths")}) {
        const json& caustic = of->at("caustic_irradiance");
        for (const char* key : {"rmse", "rel_mse", "smape", "mae", "ssim", "flip_ldr", "flip_hdr",
                                "energy_ratio", "encircled_energy_radius_ratio"}) {
            EXPECT_TRUE(caustic.at(key).is_number()) << key;
        }
        // 1,024 photons over 3,072 pixels lose what a pixel's ring around the water is short of.
        EXPECT_NEAR(caustic.at("energy_ratio").get<double>(), 1.0, 0.05);
    }
    const json& bias = error.at("bias");
    EXPECT_EQ(bias.at("against"), "modelled_paths");
    EXPECT_GT(bias.at("judged_pixels").get<int>(), 100);
    EXPECT_LE(bias.at("too_bright").get<double>() + bias.at("too_dark").get<double>(), 1.0);
    // Emitted is what the reference says; the difference to the grid is a loss by name.
    const json& energy = result.at("energy");
    EXPECT_LT(std::abs(energy.at("balance").get<double>()), 1e-4);
    EXPECT_TRUE(energy.at("lost_w").contains("emission_sampling"));
    for (const char* file : {"out/hits.png", "out/error.png", "out/bias.png", "out/reference.exr"})
        EXPECT_EQ(readImage(folder / file).width, 64) << file;
    EXPECT_EQ(readImage(folder / "out/reference.exr").values, readImage(cached(".exr")).values);
}

TEST_F(Reference, JudgesAFrameOfSeveralSamplesByItsPixels) {
    ASSERT_EQ(runAgainst("auto").exitCode, 0);
    const json one = report();
    const Outcome outcome = runAgainst("auto", {"--set", "eye.samples=4"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const json four = report();
    EXPECT_EQ(four.at("size"), one.at("size"));
    for (const char* file : {"out/caustic.exr", "out/beauty.png", "out/hits.png", "out/bias.png"})
        EXPECT_EQ(readImage(folder / file).width, 64) << file;
    // The same light, over the same area of receivers.
    const auto error = [](const json& of) { return of.at("error").at("caustic_irradiance"); };
    EXPECT_NEAR(error(four).at("energy_ratio").get<double>(),
                error(one).at("energy_ratio").get<double>(), 0.02);
    EXPECT_NEAR(four.at("hits").at("agreement").get<double>(),
                one.at("hits").at("agreement").get<double>(), 0.02);
    EXPECT_LT(std::abs(four.at("energy").at("balance").get<double>()), 1e-4);
}

TEST_F(Reference, OfARunIsComputedOnce) {
    ASSERT_EQ(runAgainst("auto").exitCode, 0);
    const auto written = fs::last_write_time(cached(".json"));
    const json first = report().at("error");
    ASSERT_EQ(runAgainst("auto").exitCode, 0);
    EXPECT_EQ(fs::last_write_time(cached(".json")), written);
    EXPECT_EQ(report().at("error"), first);
}

TEST_F(Reference, FromAFileIsTakenAsItIs) {
    ASSERT_EQ(makeReference().exitCode, 0);
    const Outcome outcome = runAgainst("reference.exr");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(report().at("error").at("reference"), "reference.exr");
    EXPECT_TRUE(report().contains("hits"));
}

TEST_F(Reference, OfAnotherSizeSceneOrTimeIsRefused) {
    ASSERT_EQ(makeReference().exitCode, 0);
    expectFailure(runCached({"run", "wavy.toml", "--size", "32x24", "--out", "out", "--reference",
                             "reference.exr"}),
                  2, {"reference.exr", "64x48", "32x24", "--size 64x48"});
    std::string other = kWavyWater;
    other.replace(other.find("1.333"), 5, "1.332");
    static_cast<void>(folder.file("wavy.toml", other));
    expectFailure(runAgainst("reference.exr"), 2, {"reference.exr", "another scene", "wavy"});
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    expectFailure(runAgainst("reference.exr", {"--time", "0.5"}), 2,
                  {"reference.exr", "another time"});
    ASSERT_EQ(makeReference({"--transmission-only"}, "part.exr").exitCode, 0);
    expectFailure(runAgainst("part.exr"), 2, {"part.exr", "a part of the paths"});
    EXPECT_FALSE(files().contains("out/report.json"));
}

TEST_F(Reference, ThatIsMissingOrDamagedIsRefusedByName) {
    expectFailure(runAgainst("nowhere.exr"), 1, {"nowhere"});
    ASSERT_EQ(makeReference().exitCode, 0);
    fs::resize_file(folder / "reference.exr", fs::file_size(folder / "reference.exr") / 2);
    expectFailure(runAgainst("reference.exr"), 1, {"reference.exr"});
    // The image of another reference under this one's name.
    ASSERT_EQ(makeReference({}, "reference.exr").exitCode, 0);
    ASSERT_EQ(makeReference({"--seed", "3"}, "other.exr").exitCode, 0);
    fs::copy_file(folder / "other.exr", folder / "reference.exr",
                  fs::copy_options::overwrite_existing);
    expectFailure(runAgainst("reference.exr"), 1, {"reference.exr", "does not belong"});
    EXPECT_FALSE(files().contains("out/report.json"));
}

TEST_F(Reference, WhoseCacheEntryIsDamagedIsMadeAgain) {
    ASSERT_EQ(runAgainst("auto").exitCode, 0);
    const json before = report().at("error");
    for (const auto& entry : fs::directory_iterator(folder / "cache/references"))
        fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
    const Outcome again = runAgainst("auto");
    ASSERT_EQ(again.exitCode, 0) << again.err;
    EXPECT_NE(again.err.find("damaged"), std::string::npos);
    EXPECT_EQ(report().at("error"), before);
    EXPECT_EQ(runAgainst("auto").err.find("damaged"), std::string::npos);
}

TEST_F(Reference, ThatIsInterruptedGoesOnWhereItStopped) {
    const std::vector<std::string> endless = {"reference", "wavy.toml", "--size",
                                              "64x48",     "--photons", "1000000000000"};
    Program program(endless, conditions());
    program.waitUntilItHandles(SIGINT);
    program.send(SIGINT);
    const Outcome interrupted = program.wait();
    expectFailure(interrupted, 1, {"Interrupted after ", "goes on"});
    const double before = std::stod(interrupted.err.substr(interrupted.err.find("after ") + 6));
    ASSERT_GE(before, 0.0);  // whole batches: the one that was under way is traced again
    for (const std::string& file : files())
        EXPECT_FALSE(fs::path(file).filename().string().starts_with('.')) << file;

    // One more batch ends it, and it is what it would be without the interruption.
    const auto reference = [&](double photons, const std::string& file) {
        EXPECT_EQ(runCached({"reference", "wavy.toml", "--size", "64x48", "--photons",
                             std::to_string(static_cast<long long>(photons)), "--out", file})
                      .exitCode,
                  0);
        return json::parse(contents(fs::path(file).replace_extension(".json").string()));
    };
    const json resumed = reference(before + 1.0, "resumed.exr");
    fs::remove_all(folder / "cache");
    const json whole = reference(before + 1.0, "whole.exr");
    EXPECT_EQ(resumed.at("photons"), whole.at("photons"));
    EXPECT_EQ(resumed.at("batches"), whole.at("batches"));
    EXPECT_EQ(readImage(folder / "resumed.exr").values, readImage(folder / "whole.exr").values);
}

TEST_F(Reference, OnAFullDiskIsAMessageAndNoHalfFile) {
    Conditions limited = conditions();
    limited.largestFileBytes = 1024;
    const Outcome outcome =
        run({"reference", "wavy.toml", "--size", "64x48", "--photons", "600000"}, limited);
    expectFailure(outcome, 1, {"cannot be written"});
    EXPECT_EQ(files(), std::set<std::string>{"wavy.toml"});
}

TEST_F(Reference, RefusesWhatMakesNoSense) {
    expectFailure(runCached({"reference"}), 2, {"scene"});
    expectFailure(runCached({"reference", "wavy.toml", "--photons", "0"}), 2, {"--photons"});
    expectFailure(runCached({"reference", "wavy.toml", "--photons", "many"}), 2, {"many"});
    expectFailure(runCached({"reference", "wavy.toml", "--seconds", "-1"}), 2, {"--seconds"});
    expectFailure(runCached({"reference", "wavy.toml", "--error", "0"}), 2, {"--error"});
    expectFailure(runCached({"reference", "wavy.toml", "--estimator", "path"}), 2,
                  {"path", "light", "sppm"});
    expectFailure(runCached({"reference", "wavy.toml", "--interactions", "0"}), 2,
                  {"--interactions"});
    expectFailure(runCached({"reference", "wavy.toml", "--size", "64"}), 2, {"--size"});
    expectFailure(runCached({"reference", "wavy.toml", "--caustic-view"}), 2, {"sppm"});
    expectFailure(runCached({"reference", "wavy.toml", "--out", "reference.png"}), 2,
                  {"reference.png", ".exr"});
    expectFailure(runCached({"reference", "nowhere"}), 2, {"nowhere"});
    expectFailure(runAgainst("none", {"--reference-photons", "0"}), 2, {"--reference-photons"});
    EXPECT_EQ(files(), std::set<std::string>{"wavy.toml"});
}

TEST_F(Reference, OfASceneWithoutCausticsSaysWhatItCan) {
    static_cast<void>(folder.file("bare.toml", R"(
name = "bare"
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[object]]
name = "floor"
shape = "plane"
material = "chalk"
size = [2, 2]
)"));
    const Outcome outcome = runCached(smallRun(
        "bare.toml", {"--out", "out", "--reference", "auto", "--reference-photons", "600000"}));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const json caustic = report().at("error").at("caustic_irradiance");
    EXPECT_EQ(caustic.at("rmse"), 0.0);
    EXPECT_TRUE(caustic.at("rel_mse").is_null());
    EXPECT_TRUE(caustic.at("reasons").at("rel_mse").is_string());
    const json hits = report().at("hits");
    EXPECT_EQ(hits.at("photons"), 0);
    EXPECT_TRUE(hits.at("agreement").is_null());
    EXPECT_TRUE(hits.at("reasons").at("agreement").is_string());
}

TEST_F(Reference, OfAMediumJudgesWhatItScatters) {
    static_cast<void>(folder.file("medium.toml", std::string(kWavyWater) + R"(
[medium]
scattering_per_meter = 0.2
)"));
    const Outcome outcome = runCached(smallRun(
        "medium.toml", {"--out", "out", "--reference", "auto", "--reference-photons", "600000"}));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("in-scattered"), std::string::npos);
    const json error = report().at("error");
    for (const json* of : {&error, &error.at("modelled_paths")}) {
        const json& scattered = of->at("in_scattered");
        EXPECT_GT(scattered.at("truth_noise").at("rmse").get<double>(), 0.0);
        // Pixels that see no receiver count too.
        EXPECT_EQ(scattered.at("counted_pixels").get<int>(), 64 * 48);
    }
    EXPECT_EQ(readImage(folder / "out/in_scattered.exr").width,
              readImage(folder / "out/reference_in_scattered.exr").width);
}

}  // namespace
}  // namespace kaustik::test
