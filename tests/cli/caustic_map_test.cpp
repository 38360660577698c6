// SPDX-License-Identifier: MIT
// Caustic maps as a user of the command line meets them: what explain says, what the report has of
// maps, and what is refused.
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;
using CausticMaps = CommandLine;

TEST_F(CausticMaps, ExplainSaysWhichPathsCannotBeFormed) {
    for (const char* technique :
         {"caustic_map", "vertex_caustics", "multi_resolution", "lens_splats", "eye_gather"}) {
        SCOPED_TRACE(technique);
        for (const auto& [scene, side] :
             {std::pair("blocker", "'rod'"), std::pair("pool-reflections", "'wall'")}) {
            const Outcome outcome =
                run({"explain", scene, "--size", "64x48", "--technique", technique});
            ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
            const std::string all = outcome.out + outcome.err;
            EXPECT_NE(all.find("warning: trace=background sees what light"), std::string::npos)
                << all;
            EXPECT_NE(all.find(side), std::string::npos) << all;
            EXPECT_NE(all.find("cannot form a path"), std::string::npos) << all;
        }
    }
}

TEST_F(CausticMaps, AreInTheReportAndNotOfTheScreen) {
    static_cast<void>(renderWater(
        {"--technique", "multi_resolution", "--set", "reconstruct.map_size=512"}, "light"));
    const json map = report("light").at("map");
    EXPECT_EQ(map.at("space"), "light");
    EXPECT_EQ(map.at("maps").at(0).at("size"), json({512, 512}));
    for (const char* key : {"flux_ratio", "blend_energy_ratio", "seen_ratio"}) {
        ASSERT_TRUE(map.at(key).is_number()) << key << map;
        EXPECT_GT(map.at(key), 0.5) << key;
        EXPECT_LT(map.at(key), 1.5) << key;
    }
    static_cast<void>(renderWater({}, "screen"));
    EXPECT_FALSE(report("screen").contains("map"));
}

TEST_F(CausticMaps, TakeAnySizeThatFits) {
    for (const char* size : {"5000", "16"}) {
        static_cast<void>(renderWater(
            {"--technique", "caustic_map", "--set", std::string("reconstruct.map_size=") + size},
            size));
        EXPECT_EQ(report(size).at("map").at("maps").at(0).at("size").at(0), std::stoi(size));
    }
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    expectFailure(run(smallRun("wavy.toml", {"--technique", "caustic_map", "--set",
                                             "reconstruct.map_size=9000"})),
                  2, {"reconstruct.map_size", "8192"});
}

TEST_F(CausticMaps, SayWhatToSetBesidesTheirSpace) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    expectFailure(run(smallRun("wavy.toml", {"--set", "reconstruct.space=light"})), 2,
                  {"gather.screen", "gather=project", "reconstruct.space=screen"});
}

}  // namespace
}  // namespace kaustik::test
