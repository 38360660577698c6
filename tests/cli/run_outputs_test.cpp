// SPDX-License-Identifier: MIT
// What 'kaustik run' leaves behind: the pictures, the saved resources and the trace. The report has
// a file of its own.
#include <algorithm>
#include <cmath>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;
using RunCommand = CommandLine;

const std::set<std::string> kOutputs = {"out/beauty.png", "out/beauty.exr",   "out/caustic.exr",
                                        "out/trace.json", "out/samples.json", "out/report.json"};

std::set<std::string> inOut(std::set<std::string> names) {
    names.erase("wavy.toml");
    return names;
}

void expectSize(const Image& image, int width, int height, int channels) {
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.channels, channels);
}

TEST_F(RunCommand, WritesSixFilesAndNamesThem) {
    const Outcome outcome = renderWater();
    EXPECT_EQ(inOut(files()), kOutputs);
    EXPECT_EQ(outcome.err, "");
    for (const std::string& file : kOutputs) {
        EXPECT_NE(outcome.out.find("wrote " + file + "\n"), std::string::npos) << outcome.out;
    }
}

TEST_F(RunCommand, WritesIntoAFolderNamedAfterSceneAndTechniqueByDefault) {
    const std::filesystem::path scene = folder.file("wavy.toml", kWavyWater);
    EXPECT_EQ(run(smallRun(scene.string())).exitCode, 0);
    EXPECT_TRUE(files().contains("results/runs/wavy-exact_rays/report.json"));
}

TEST_F(RunCommand, RendersTheDefaultSceneWhenNoneIsNamed) {
    const Outcome outcome = run({"run", "--size", "16x12", "--frames", "1", "--warmup", "0",
                                 "--set", "photons=8x8", "--out", "out"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(report().at("scene").at("name"), "pool");
    EXPECT_GT(report().at("scene").at("triangles"), 69000);  // the bunny is in it
}

TEST_F(RunCommand, SaysWhereASeedHasNoEffect) {
    const Outcome outcome = renderWater({"--seed", "7"});
    EXPECT_NE(outcome.out.find("warning: --seed 7 has no effect"), std::string::npos)
        << outcome.out;
    EXPECT_EQ(report().at("warnings").size(), 1u);
}

TEST_F(RunCommand, PicturesHaveTheSizeThatWasAskedFor) {
    static_cast<void>(renderWater({"--seed", "7"}));
    expectSize(readImage(folder / "out/beauty.png"), 64, 48, 3);
    expectSize(readImage(folder / "out/beauty.exr"), 64, 48, 3);
    expectSize(readImage(folder / "out/caustic.exr"), 64, 48, 3);
    EXPECT_EQ(report().at("seed"), 7);
}

TEST_F(RunCommand, CausticIsFiniteLightOnTheFloor) {
    static_cast<void>(renderWater());
    const Image caustic = readImage(folder / "out/caustic.exr");
    float brightest = 0.0f;
    for (const float value : caustic.values) {
        ASSERT_TRUE(std::isfinite(value));
        ASSERT_GE(value, 0.0f);
        brightest = std::max(brightest, value);
    }
    // The sun's 1000 W/m² less a few percent at the surface; waves only concentrate it.
    EXPECT_GT(brightest, 500.0f);
}

TEST_F(RunCommand, TraceHasEveryPassOfEveryTimedFrame) {
    static_cast<void>(renderWater({"--precise"}));
    const json trace = json::parse(contents("out/trace.json"));
    std::multiset<std::string> names;
    for (const json& event : trace.at("traceEvents")) {
        if (event.at("ph") == "C") continue;
        EXPECT_EQ(event.at("ph"), "X") << event;
        EXPECT_GE(event.at("ts").get<double>(), 0.0) << event;
        EXPECT_GE(event.at("dur").get<double>(), 0.0) << event;
        names.insert(event.at("name").get<std::string>());
    }
    const json report = this->report();
    for (const json& pass : report.at("passes")) {
        if (!pass.at("ran").get<bool>()) continue;
        EXPECT_GE(names.count(pass.at("name")), 1u) << pass.at("name");
    }
}

TEST_F(RunCommand, TraceCountsTimeMemoryAndPhotonsAsTheReportDoes) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    const Outcome outcome = run({"run", "wavy.toml", "--size", "32x24", "--set", "photons=8x8",
                                 "--frames", "2", "--precise", "--out", "out"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const json trace = json::parse(contents("out/trace.json"));
    const json samples = json::parse(contents("out/samples.json"));
    const json report = this->report();
    std::vector<double> frameTimes;
    std::vector<double> frameBegins;
    double maxBytes = 0.0;
    std::set<double> bytes;
    json photons;
    for (const json& event : trace.at("traceEvents")) {
        const std::string name = event.at("name");
        if (name.starts_with("frame ")) frameBegins.push_back(event.at("ts"));
        if (event.at("ph") != "C") continue;
        const json& values = event.at("args");
        EXPECT_GE(event.at("ts").get<double>(), 0.0) << event;
        if (name == "time") {
            frameTimes.push_back(values.at("device_ms"));
            EXPECT_EQ(event.at("ts"), frameBegins.back());
        } else if (name == "memory") {
            bytes.insert(values.at("texture_bytes").get<double>() +
                         values.at("buffer_bytes").get<double>());
            maxBytes = *bytes.rbegin();
        } else {
            EXPECT_EQ(name, "photons");
            EXPECT_EQ(event.at("ts"), frameBegins.back());
            photons = values;
        }
    }
    EXPECT_EQ(frameTimes, samples.at("frame_samples_ms").get<std::vector<double>>());
    EXPECT_EQ(photons, report.at("photons"));
    EXPECT_GT(photons.at("hit"), 0);
    EXPECT_EQ(maxBytes, report.at("memory").at("peak_bytes"));
    EXPECT_GT(bytes.size(), 3u);  // it goes up and down
}

TEST_F(RunCommand, SavesATextureUnderItsName) {
    static_cast<void>(renderWater({"--save", "photons.flux"}));
    std::set<std::string> expected = kOutputs;
    expected.insert("out/photons.flux.exr");
    EXPECT_EQ(inOut(files()), expected);
    expectSize(readImage(folder / "out/photons.flux.exr"), 32, 32, 4);
}

TEST_F(RunCommand, SavesAnArrayTextureAsOneFileALayer) {
    static_cast<void>(renderWater({"--save", "layers.depth", "--set", "layers.count=3"}));
    std::set<std::string> expected = kOutputs;
    for (const char* layer : {"0", "1", "2"}) {
        expected.insert("out/layers.depth." + std::string(layer) + ".exr");
    }
    EXPECT_EQ(inOut(files()), expected);
    const Image nearest = readImage(folder / "out/layers.depth.0.exr");
    EXPECT_EQ(nearest.width, 64);
    EXPECT_EQ(nearest.height, 48);
}

TEST_F(RunCommand, TheSameTimeTwiceGivesTheSameCausticBitForBit) {
    static_cast<void>(renderWater({"--time", "0.3"}, "first"));
    static_cast<void>(renderWater({"--time", "0.3"}, "second"));
    EXPECT_TRUE(contents("first/caustic.exr") == contents("second/caustic.exr"));
    EXPECT_FLOAT_EQ(report("first").at("time_s").get<float>(), 0.3f);
}

// What is timed then is the same light, and the frame that is measured has its ledger all the same.
TEST_F(RunCommand, TimesFramesWithoutTheLedgerWhereAsked) {
    static_cast<void>(renderWater({}, "with"));
    static_cast<void>(renderWater({"--no-ledger"}, "without"));
    EXPECT_TRUE(contents("with/caustic.exr") == contents("without/caustic.exr"));
    EXPECT_EQ(report("with").at("timing").at("ledger"), true);
    EXPECT_EQ(report("without").at("timing").at("ledger"), false);
    EXPECT_EQ(report("with").at("energy"), report("without").at("energy"));
    EXPECT_GT(report("without").at("energy").at("emitted_w").get<double>(), 0.0);
}

TEST_F(RunCommand, AnotherTimeMovesTheWater) {
    static_cast<void>(renderWater({"--time", "0"}, "first"));
    static_cast<void>(renderWater({"--time", "0.3"}, "second"));
    EXPECT_NE(readImage(folder / "first/caustic.exr").values,
              readImage(folder / "second/caustic.exr").values);
}

TEST_F(RunCommand, ASecondRunReplacesTheFirstOnesFiles) {
    static_cast<void>(renderWater({"--seed", "1"}));
    static_cast<void>(renderWater({"--seed", "2"}));
    EXPECT_EQ(inOut(files()), kOutputs);
    EXPECT_EQ(report().at("seed"), 2);
}

}  // namespace
}  // namespace kaustik::test
