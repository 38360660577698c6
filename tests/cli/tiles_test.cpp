// SPDX-License-Identifier: MIT
// kaustik run --tile and kaustik tiles: one picture from processes that know one tile of the screen
// each (K06, section 6).
#include <filesystem>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;

class TilesOfTheScreen : public CommandLine {
  protected:
    TilesOfTheScreen() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }

    [[nodiscard]] Outcome water(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {"--technique", "screen_space_photons"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(smallRun("wavy.toml", arguments));
    }
    void trace(const std::string& tile, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"--tile", tile, "--tiles", "t"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = water(arguments);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    void expectRefused(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& parts) const {
        expectFailure(water(arguments), 2, parts);
    }
};

TEST_F(TilesOfTheScreen, GiveTheFilesOfTheWholePicture) {
    ASSERT_EQ(water({"--out", "whole"}).exitCode, 0);
    for (const char* tile : {"2/3", "1/3", "3/3"})
        trace(tile);
    const Outcome merged = run({"tiles", "t"});
    ASSERT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_NE(merged.out.find("no further round"), std::string::npos) << merged.out;
    for (const char* tile : {"\ntile 1: ", "\ntile 2: ", "\ntile 3: "})
        EXPECT_NE(merged.out.find(tile), std::string::npos) << merged.out;
    EXPECT_EQ(merged.out.find("\ntile 4: "), std::string::npos) << merged.out;
    const Outcome picture = water({"--tiles", "t", "--out", "tiled"});
    ASSERT_EQ(picture.exitCode, 0) << picture.err;
    for (const char* file : {"/caustic", "/beauty"}) {
        const std::string name = file + floatImageExtension();
        EXPECT_EQ(contents("tiled" + name), contents("whole" + name)) << name;
    }
    EXPECT_EQ(report("tiled").at("energy"), report("whole").at("energy"));
    EXPECT_EQ(report("tiled").at("photons"), report("whole").at("photons"));
}

TEST_F(TilesOfTheScreen, AreTracedOnceAndMergedOnce) {
    trace("1/1");
    const auto before = fs::last_write_time(folder / "t/round-1-tile-1-of-1.hits");
    const Outcome again = water({"--tile", "1/1", "--tiles", "t"});
    EXPECT_NE(again.out.find("it was there already"), std::string::npos) << again.out;
    EXPECT_EQ(fs::last_write_time(folder / "t/round-1-tile-1-of-1.hits"), before);
    ASSERT_EQ(run({"tiles", "t"}).exitCode, 0);
    for (const Outcome& after : {run({"tiles", "t"}), water({"--tile", "1/1", "--tiles", "t"})}) {
        EXPECT_EQ(after.exitCode, 0) << after.err;
        EXPECT_NE(after.out.find("no further round"), std::string::npos) << after.out;
    }
}

TEST_F(TilesOfTheScreen, ThatCannotBeAreRefused) {
    expectRefused({"--tile", "2", "--tiles", "t"}, {"--tile", "'2' is not K/N", "tiles"});
    expectRefused({"--tile", "3/2", "--tiles", "t"}, {"there is no tile 3 of 2"});
    expectRefused({"--tile", "1/5000", "--tiles", "t"}, {"64x48", "5000 tiles"});
    expectRefused({"--tile", "1/97", "--tiles", "t"}, {"64x48", "97 tiles"});
    expectRefused({"--tile", "1/2"}, {"--tile", "--tiles"});
    expectRefused({"--tile", "1/2", "--tiles", "t", "--out", "out"}, {"--tile", "no picture"});
    expectRefused({"--tile", "1/2", "--tiles", "t", "--disable", "layers.pyramid"}, {"--tiles"});
    expectRefused({"--tile", "1/2", "--tiles", "t", "--set", "trace=plane"},
                  {"trace=plane", "trace=hierarchical"});
    expectRefused({"--tile", "1/2", "--tiles", "t", "--set", "layers=per_object"},
                  {"layers=per_object", "layers=peel"});
    expectRefused({"--tile", "1/2", "--tiles", "t", "--set", "hierarchical.steps=16"},
                  {"trace.hierarchical.steps = 16", "64"});
    EXPECT_TRUE(files() == std::set<std::string>{"wavy.toml"});
}

TEST_F(TilesOfTheScreen, ThatAreMissingAreNamed) {
    expectFailure(run({"tiles", "t"}), 2, {"no folder t"});
    trace("1/4");
    trace("4/4");
    expectFailure(run({"tiles", "t"}), 2, {"of the 4 tiles of round 1", "2 and 3"});
    expectRefused({"--tiles", "t"}, {"in t", "still on their way", "after 0 merged rounds"});
    trace("1/2");
    expectFailure(run({"tiles", "t"}), 2, {"round 1 has tiles of"});
}

TEST_F(TilesOfTheScreen, OfAnotherRunAreRefusedByWhatDiffers) {
    trace("1/2");
    expectRefused({"--tile", "1/2", "--tiles", "t", "--set", "photons=16x16"},
                  {"round-1-tile-1-of-2.hits", "emit.photons is 32x32 there and 16x16 here"});
    trace("2/2", {"--set", "trace=march"});
    expectFailure(run({"tiles", "t"}), 2, {"round-1-tile-2-of-2.hits", "trace is march there"});
    fs::remove(folder / "t/round-1-tile-2-of-2.hits");
    trace("2/2");
    ASSERT_EQ(run({"tiles", "t"}).exitCode, 0);
    expectRefused({"--tiles", "t", "--time", "0.5"}, {"round-1.hits", "time_s is 0.0 there"});
    expectRefused({"--tile", "1/3", "--tiles", "t"}, {"is of 2 tiles, not of 3"});
    std::string bytes = contents("t/round-1.hits");
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    static_cast<void>(folder.file("t/round-1.hits", bytes));
    expectFailure(water({"--tiles", "t"}), 1, {"round-1.hits", "checksum"});
}

}  // namespace
}  // namespace kaustik::test
