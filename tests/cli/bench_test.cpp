// SPDX-License-Identifier: MIT
// kaustik bench: times are kept, compared, and not compared where that would say nothing.
#include "framework/core/files.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class BenchCommand : public CommandLine {
  protected:
    [[nodiscard]] Outcome save(const std::string& file, const std::string& photons) const {
        return run({"bench", "save", file, "--scene", "flat-water", "--size", "32x24", "--rounds",
                    "2", "--frames", "1", "--set", "photons=" + photons});
    }
};

TEST_F(BenchCommand, KeepsTimesAndComparesThem) {
    ASSERT_EQ(save("before.json", "8x8").exitCode, 0);
    const json kept = json::parse(contents("before.json"));
    EXPECT_EQ(kept.at("schema"), "kaustik.bench/1");
    EXPECT_EQ(kept.at("scenes").at("flat-water").at("frame_ms").size(), 2u);
    EXPECT_TRUE(kept.at("scenes").at("flat-water").at("passes").contains("emit.grid"));

    json slower = kept;
    slower["scenes"]["flat-water"]["frame_ms"] = {2e6, 2.0001e6};
    json before = kept;
    before["scenes"]["flat-water"]["frame_ms"] = {1e6, 1.0001e6};
    writeFileWhole(folder / "fast.json", before.dump());
    writeFileWhole(folder / "slow.json", slower.dump());
    const Outcome same = run({"bench", "compare", "fast.json", "fast.json"});
    EXPECT_EQ(same.exitCode, 0) << same.err;
    EXPECT_NE(same.out.find("no difference seen"), std::string::npos) << same.out;
    const Outcome twice = run({"bench", "compare", "fast.json", "slow.json"});
    EXPECT_EQ(twice.exitCode, 0) << twice.err;
    EXPECT_NE(twice.out.find("slower"), std::string::npos) << twice.out;
    const Outcome limited =
        run({"bench", "compare", "fast.json", "slow.json", "--max-slower", "5"});
    EXPECT_EQ(limited.exitCode, 1);
    EXPECT_NE(limited.err.find("flat-water is slower by at least"), std::string::npos)
        << limited.err;
    EXPECT_EQ(run({"bench", "compare", "slow.json", "fast.json", "--max-slower", "5"}).exitCode, 0);
}

TEST_F(BenchCommand, RefusesWhatSaysNothing) {
    EXPECT_EQ(run({"bench", "keep", "a.json"}).exitCode, 2);
    EXPECT_EQ(run({"bench", "save", "a.json", "--rounds", "1"}).exitCode, 2);
    EXPECT_EQ(run({"bench", "save", "a.json", "b.json"}).exitCode, 2);
    EXPECT_EQ(run({"bench", "compare", "a.json"}).exitCode, 2);
    EXPECT_EQ(run({"bench", "compare", "a.json", "b.json"}).exitCode, 1);
    ASSERT_EQ(save("a.json", "8x8").exitCode, 0);
    ASSERT_EQ(save("b.json", "4x4").exitCode, 0);
    const Outcome other = run({"bench", "compare", "a.json", "b.json"});
    EXPECT_EQ(other.exitCode, 2);
    EXPECT_NE(other.err.find("photons=4x4"), std::string::npos) << other.err;
    EXPECT_EQ(run({"bench", "save", "c.json", "--scene", "nowhere"}).exitCode, 2);
    EXPECT_FALSE(files().contains("c.json"));
}

}  // namespace
}  // namespace kaustik::test
