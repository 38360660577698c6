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

TEST_F(CausticMaps, AsPublishedSayWhatTheyLoseByThat) {
    const auto renderBall = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments =
            smallRun("glass-sphere", {"--technique", "caustic_map", "--out", "out"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.out + outcome.err;
    };
    const std::string published = renderBall({"--as-published"});
    EXPECT_EQ(report().at("as_published"), true);
    EXPECT_EQ(report().at("parameters").at("reconstruct.fixed.edges"), "crossed");
    EXPECT_GT(report().at("energy").at("lost_w").at("as_published"), 0.0);
    EXPECT_NE(published.find("is lost as published"), std::string::npos) << published;
    const std::string byDefault = renderBall({});
    EXPECT_EQ(report().at("as_published"), false);
    EXPECT_FALSE(report().at("energy").at("lost_w").contains("as_published"));
    EXPECT_EQ(byDefault.find("as published"), std::string::npos) << byDefault;
    EXPECT_EQ(byDefault.find("booked as internal_reflection_limit"), std::string::npos)
        << byDefault;
    // A technique that is no paper's has no such row.
    expectFailure(run(smallRun("glass-sphere", {"--technique", "raytraced", "--as-published"})), 2,
                  {"raytraced", "as published"});
    const Outcome listed =
        run({"list", "params", "--technique", "caustic_map", "--as-published", "--json"});
    EXPECT_NE(listed.out.find("crossed"), std::string::npos);
}

}  // namespace
}  // namespace kaustik::test
