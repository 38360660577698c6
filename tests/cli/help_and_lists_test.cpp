// SPDX-License-Identifier: MIT
// What the program says about itself: --help, --version, list, explain and check.
#include <algorithm>
#include <regex>

#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;
using Help = CommandLine;
using List = CommandLine;
using Explain = CommandLine;
using Check = CommandLine;

void expectAllIn(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) {
        EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in:\n"
                                                      << text;
    }
}

std::vector<std::string> namesIn(const json& entries) {
    std::vector<std::string> names;
    for (const json& entry : entries)
        names.push_back(entry.at("name"));
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

TEST_F(Help, NamesEverySubcommand) {
    const Outcome outcome = run({"--help"});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.err, "");
    expectAllIn(outcome.out, {"run", "list", "doc", "explain", "reference", "census", "compare",
                              "import", "export", "judge", "experiment", "check", "--version"});
}

TEST_F(Help, OfRunNamesEveryOption) {
    const Outcome outcome = run({"run", "--help"});
    EXPECT_EQ(outcome.exitCode, 0);
    expectAllIn(outcome.out,
                {"scene", "--technique", "--set", "--disable", "--size", "--frames", "--warmup",
                 "--time", "--seed", "--precise", "--reference", "--save", "--out", "--gl-debug"});
}

TEST_F(Help, VersionIsThreeNumbers) {
    const Outcome outcome = run({"--version"});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_TRUE(std::regex_match(outcome.out, std::regex(R"(\d+\.\d+\.\d+\n)"))) << outcome.out;
}

// One line of the table: what is listed, which keys each entry has, and a name that is among them.
struct Kind {
    std::string what;
    std::set<std::string> keys;
    std::string aName;
};

class ListOf : public CommandLine, public testing::WithParamInterface<Kind> {};

TEST_P(ListOf, IsTheSameForPeopleAndAsJson) {
    const Outcome asJson = run({"list", GetParam().what, "--json"});
    const Outcome plain = run({"list", GetParam().what});
    ASSERT_EQ(asJson.exitCode, 0) << asJson.err;
    ASSERT_EQ(plain.exitCode, 0) << plain.err;
    EXPECT_EQ(plain.err + asJson.err, "");
    const json entries = json::parse(asJson.out);
    ASSERT_TRUE(entries.is_array());
    for (const json& entry : entries) {
        std::set<std::string> keys;
        for (const auto& [key, value] : entry.items())
            keys.insert(key);
        std::set<std::string> expected = GetParam().keys;
        if (const std::string type = entry.value("type", "bool"); type == "choice") {
            expected.insert("choices");
        } else if (type != "bool") {
            expected.insert({"minimum", "maximum"});
        }
        // It takes squares alone.
        if (entry.value("name", "") == "eye.samples") expected.insert("values");
        EXPECT_EQ(keys, expected) << entry;
        EXPECT_FALSE(entry.at("description").get<std::string>().empty()) << entry;
    }
    const std::vector<std::string> names = namesIn(entries);
    EXPECT_TRUE(contains(names, GetParam().aName));
    // At the start of a line, and apart from what follows.
    for (const std::string& name : names) {
        const std::regex line("(^|\n)" + std::regex_replace(name, std::regex("\\."), "\\.") +
                              "(  | = )\\S?");
        EXPECT_TRUE(std::regex_search(plain.out, line)) << name << " in:\n" << plain.out;
    }
}

std::string kindName(const testing::TestParamInfo<Kind>& kind) {
    return kind.param.what;
}

INSTANTIATE_TEST_SUITE_P(
    Every, ListOf,
    testing::Values(
        Kind{"scenes", {"name", "description", "file"}, "pool"},
        Kind{"techniques",
             {"name", "description", "source", "defaults", "as_published"},
             "screen_space_photons"},
        Kind{"nodes", {"name", "stage", "description", "source", "limits"}, "trace.lines"},
        Kind{"params",
             {"name", "type", "default", "unit", "range", "description"},
             "trace.epsilon"}),
    kindName);

TEST_F(List, WithATechniqueHasOneNodeForEachStage) {
    const json all = json::parse(run({"list", "nodes", "--json"}).out);
    const json chosen =
        json::parse(run({"list", "nodes", "--technique", "screen_space_photons", "--json"}).out);
    std::set<std::string> stages;
    for (const json& node : chosen) {
        EXPECT_TRUE(stages.insert(node.at("stage")).second) << node << " is a second answer";
        EXPECT_TRUE(contains(namesIn(all), node.at("name"))) << node;
    }
    EXPECT_TRUE(contains(namesIn(chosen), "reconstruct.triangles"));
}

TEST_F(List, WithATechniqueHasTheParametersOfItsNodesOnly) {
    const std::vector<std::string> nodes = namesIn(
        json::parse(run({"list", "nodes", "--technique", "screen_space_photons", "--json"}).out));
    const json params =
        json::parse(run({"list", "params", "--technique", "screen_space_photons", "--json"}).out);
    for (const std::string& name : namesIn(params)) {
        if (std::count(name.begin(), name.end(), '.') < 2) continue;  // of a stage, not of a node
        EXPECT_TRUE(contains(nodes, name.substr(0, name.rfind('.')))) << name;
    }
    EXPECT_TRUE(contains(namesIn(params), "trace.hierarchical.steps"));
}

TEST_F(Explain, SaysOfEveryNodeWhyItRunsOrNot) {
    const Outcome outcome = run({"explain", "ring", "--size", "64x48"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    expectAllIn(outcome.out, {"scene ring", "technique exact_rays", "emit.grid", "photons.flux",
                              "caustic.irradiance"});
    EXPECT_TRUE(
        std::regex_search(outcome.out, std::regex("geometry\\.height_field +skipped +\\w+")))
        << outcome.out;
    EXPECT_TRUE(std::regex_search(outcome.out, std::regex("trace\\.(bvh|raytraced) +runs +\\w+")))
        << outcome.out;
    EXPECT_TRUE(files().empty());
}

TEST_F(Explain, LeavesOutOfAMirrorsViewWhatOnlyDielectricsNeed) {
    for (const std::string view : {"refraction", "image_space"}) {
        const Outcome outcome =
            run({"explain", "ring", "--size", "64x48", "--set", "view=" + view});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const std::string passes = view == "refraction" ? "layers" : "back_faces";
        EXPECT_TRUE(std::regex_search(
            outcome.out, std::regex("view\\." + passes + " +skipped +the scene has no dielectric")))
            << outcome.out;
        EXPECT_TRUE(std::regex_search(outcome.out, std::regex("view\\." + view + " +runs")))
            << outcome.out;
    }
}

TEST_F(Explain, ShowsADisabledPassAsBypassed) {
    const Outcome outcome = run({"explain", "ring", "--size", "64x48", "--disable", "triangles"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(std::regex_search(
        outcome.out,
        std::regex("reconstruct\\.triangles +bypassed +disabled; .*'caustic.flux' is 0")))
        << outcome.out;
}

TEST_F(Explain, DrawsEveryPassAndResourceAsGraphviz) {
    const Outcome outcome =
        run({"explain", "ring", "--size", "64x48", "--set", "trace=bvh", "--dot", "graph.dot"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(files(), std::set<std::string>{"graph.dot"});
    const std::string dot = contents("graph.dot");
    EXPECT_TRUE(dot.starts_with("digraph")) << dot;
    EXPECT_TRUE(dot.ends_with("}\n")) << dot;
    expectAllIn(dot, {"trace.bvh", "reconstruct.triangles", "photons.flux", "caustic.irradiance"});
    // Each arrow joins two nodes that are declared with a label.
    const std::regex arrow(R"( (\w+) -> (\w+);)");
    std::size_t arrows = 0;
    for (std::sregex_iterator match(dot.begin(), dot.end(), arrow), end; match != end; ++match) {
        ++arrows;
        for (const std::size_t side : {1u, 2u}) {
            const std::string node = match->str(side);
            EXPECT_NE(dot.find(std::string(1, ' ').append(node).append(" [shape=")),
                      std::string::npos)
                << node;
        }
    }
    EXPECT_GT(arrows, 20u);
}

TEST_F(Check, PrintsWhatTheDeviceOffers) {
    const Outcome outcome = run({"check"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    expectAllIn(outcome.out, {"OpenGL ", "4.", "EGL platform", "largest texture",
                              "Everything that Kaustik needs is there."});
    std::smatch programs;
    ASSERT_TRUE(std::regex_search(
        outcome.out, programs,
        std::regex(R"(all (\d+) programs of all techniques on 'pool' fit this device)")))
        << outcome.out;
    EXPECT_GT(std::stoi(programs[1].str()), 100);
}

TEST_F(Explain, SaysWhetherTheDeviceHasWhatTheProgramsTake) {
    const Outcome outcome = run({"explain", "flat-water", "--size", "64x48"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(std::regex_search(outcome.out,
                                  std::regex(R"(\nall \d+ programs of a run fit this device\n)")))
        << outcome.out;
    EXPECT_TRUE(std::regex_search(outcome.out, std::regex(R"(\nmemory \d+ MiB for the frame's)")))
        << outcome.out;
}

}  // namespace
}  // namespace kaustik::test
