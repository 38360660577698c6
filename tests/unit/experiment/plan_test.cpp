// SPDX-License-Identifier: MIT
// From an experiment file to its runs: order, resolution, names.
#include "framework/experiment/plan.h"

#include <algorithm>

#include "tests/unit/experiment/fixture.h"

namespace kaustik::experiment {
namespace {

using nlohmann::json;
using Permutation = Experiment;
using Ranges = Experiment;
using Settings = Experiment;
using Hash = Experiment;

std::vector<json> valuesOf(const Plan& plan, const std::string& axis) {
    std::vector<json> values;
    for (const PlannedRun& run : plan.runs)
        values.push_back(run.axes.at(axis));
    return values;
}

TEST_F(Permutation, WithoutAxesIsTheBaseAlone) {
    const Plan plan = this->plan("name = 'one'\n[base]\nepsilon = 0.5\n");
    ASSERT_EQ(plan.runs.size(), 1u);
    EXPECT_EQ(plan.spec.repeats, 1);
    EXPECT_EQ(plan.runs[0].settings.at("parameters").at("trace.epsilon"), 0.5);
    EXPECT_TRUE(plan.runs[0].axes.empty());
}

TEST_F(Permutation, IsTheCrossProductInTheOrderOfTheFileWithTheLastAxisFastest) {
    const Plan plan = this->plan(R"(
name = "cross"
[permute]
trace = ["march", "lines"]
epsilon = [0.1, 0.2, 0.3]
)");
    EXPECT_EQ(valuesOf(plan, "trace"),
              (std::vector<json>{"march", "march", "march", "lines", "lines", "lines"}));
    EXPECT_EQ(valuesOf(plan, "trace.epsilon"), (std::vector<json>{0.1, 0.2, 0.3, 0.1, 0.2, 0.3}));
    ASSERT_EQ(plan.axes.size(), 2u);
    EXPECT_EQ(plan.axes[0].key, "trace");
    EXPECT_EQ(plan.axes[1].unit, "m");
}

TEST_F(Permutation, OfSeveralTablesRunsWhatTheyShareOnce) {
    const Plan plan = this->plan(R"(
name = "sweeps"
[[permute]]
epsilon = [0.01, 0.1]
[[permute]]
width = [0, 64]
)");
    // 0.01 and 0 are the defaults, so the first run belongs to both sweeps.
    ASSERT_EQ(plan.runs.size(), 3u);
    EXPECT_EQ(plan.runs[0].products, (std::vector<int>{0, 1}));
    EXPECT_EQ(plan.runs[1].products, std::vector<int>{0});
    EXPECT_EQ(plan.runs[2].products, std::vector<int>{1});
    EXPECT_EQ(valuesOf(plan, "trace.lines.width"), (std::vector<json>{0, 0, 64}));
    EXPECT_EQ(plan.axes[0].products, std::vector<int>{0});
    EXPECT_EQ(plan.axes[1].products, std::vector<int>{1});
}

TEST_F(Permutation, CountsBeforeTheBase) {
    const Plan plan = this->plan("name = 'x'\n[base]\nwidth = 8\n[permute]\nlines.width = [16]\n");
    EXPECT_EQ(valuesOf(plan, "trace.lines.width"), std::vector<json>{16});
}

TEST_F(Permutation, OfThePassesThatAreDisabledTakesLists) {
    const Plan plan = this->plan("name = 'x'\n[permute]\ndisable = [[], ['b', 'a'], 'c']\n");
    EXPECT_EQ(valuesOf(plan, "disable"), (std::vector<json>{"none", "a b", "c"}));
    const std::vector<std::string>& arguments = plan.runs[1].sceneArguments;
    EXPECT_NE(std::find(arguments.begin(), arguments.end(), "--disable=b"), arguments.end());
}

TEST_F(Ranges, MultiplyToTheEndAndStayWhole) {
    const Plan plan =
        this->plan("name = 'x'\n[permute]\nwidth = {from = 64, to = 2048, factor = 2}\n");
    EXPECT_EQ(valuesOf(plan, "trace.lines.width"),
              (std::vector<json>{64, 128, 256, 512, 1024, 2048}));
}

TEST_F(Ranges, MultiplyToNoMoreThanTheEnd) {
    const Plan plan = this->plan("name = 'x'\n[permute]\nwidth = {from=1, to=9, factor=2}\n");
    EXPECT_EQ(valuesOf(plan, "trace.lines.width"), (std::vector<json>{1, 2, 4, 8}));
}

TEST_F(Ranges, GoDownwardsToo) {
    const Plan plan =
        this->plan("name = 'x'\n[permute]\nepsilon = {from = 0.1, to = 0.001, factor = 0.1}\n");
    EXPECT_EQ(valuesOf(plan, "trace.epsilon"), (std::vector<json>{0.1, 0.01, 0.001}));
}

TEST_F(Ranges, AddWithoutTheDustOfBinaryFractions) {
    const Plan plan =
        this->plan("name = 'x'\n[permute]\nepsilon = {from = 0.1, to = 0.4, step = 0.1}\n");
    EXPECT_EQ(valuesOf(plan, "trace.epsilon"), (std::vector<json>{0.1, 0.2, 0.3, 0.4}));
}

TEST_F(Ranges, DivideIntoSteps) {
    const Plan plan = this->plan("name = 'x'\n[permute]\ntime = {from = 0, to = 1, steps = 5}\n");
    EXPECT_EQ(valuesOf(plan, "time"), (std::vector<json>{0.0, 0.25, 0.5, 0.75, 1.0}));
}

TEST_F(Settings, AreAllOfThemUnderTheirFullNames) {
    const json settings = plan("name = 'x'\n[base]\nphotons = '32x16'\n").runs[0].settings;
    EXPECT_EQ(settings.at("parameters"), (json{{"trace", "lines"},
                                               {"trace.epsilon", 0.01},
                                               {"trace.lines.width", 0},
                                               {"emit.photons", "32x16"}}));
    EXPECT_EQ(settings.at("scene").at("name"), "empty.toml");
    EXPECT_EQ(settings.at("technique"), "screen");
    EXPECT_EQ(settings.at("size"), "64x48");
    EXPECT_EQ(settings.at("frames"), 8);
    EXPECT_EQ(settings.at("warmup"), 1);
    EXPECT_EQ(settings.at("seed"), 1);
    EXPECT_EQ(settings.at("time_s"), 0.5);  // the scene's own
    EXPECT_EQ(settings.at("precise"), false);
    EXPECT_EQ(settings.at("reference"), "none");
    EXPECT_EQ(settings.at("disable"), json::array());
}

TEST_F(Settings, NameNothingOfThisMachine) {
    const std::string text = plan("name = 'x'\n").runs[0].settings.dump();
    EXPECT_EQ(text.find(folder / ""), std::string::npos) << text;
}

TEST_F(Settings, ArePassedOnOnlyWhereTheExperimentSetsThem) {
    const PlannedRun run = plan("name = 'x'\n[base]\nwidth = 64\nprecise = true\n").runs[0];
    EXPECT_EQ(run.sceneArguments,
              (std::vector<std::string>{(folder / "empty.toml").string(), "--technique=screen",
                                        "--size=64x48", "--set=trace.lines.width=64"}));
    EXPECT_EQ(run.runArguments, (std::vector<std::string>{"--frames=8", "--warmup=1", "--seed=1",
                                                          "--reference=none", "--precise"}));
}

TEST_F(Settings, TakeTheLedgerOfTimedFramesAsAnAxis) {
    const Plan both = plan("name = 'x'\n[permute]\nledger = [true, false]\n");
    EXPECT_EQ(both.runs[0].hash, plan("name = 'x'\n").runs[0].hash);
    EXPECT_EQ(both.runs[0].runArguments.back(), "--reference=none");
    EXPECT_EQ(both.runs[1].runArguments.back(), "--no-ledger");
}

TEST_F(Settings, TakeAPapersRowAsAnAxis) {
    const Plan both = plan("name = 'x'\n[permute]\nas_published = [false, true]\n");
    ASSERT_EQ(both.runs.size(), 2u);
    EXPECT_EQ(both.runs[0].axes.at("as_published"), false);
    EXPECT_EQ(both.runs[1].axes.at("as_published"), true);
    const auto isAsked = [](const PlannedRun& run) {
        return std::count(run.sceneArguments.begin(), run.sceneArguments.end(), "--as-published");
    };
    EXPECT_EQ(isAsked(both.runs[0]), 0);
    EXPECT_EQ(isAsked(both.runs[1]), 1);
    // Studies of the default rows keep the folders that they have.
    EXPECT_EQ(both.runs[0].hash, plan("name = 'x'\n").runs[0].hash);
    EXPECT_NE(problem("name = 'x'\n[base]\nas_published = 1\n").find("as_published"),
              std::string::npos);
}

TEST_F(Hash, IsThatOfTheCanonicalSettings) {
    const PlannedRun run = plan("name = 'x'\n").runs[0];
    EXPECT_EQ(run.hash.size(), 32u);
    EXPECT_EQ(run.hash.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST_F(Hash, DoesNotDependOnTheOrderOfKeysNorOnHowTheyAreWritten) {
    const std::string hash =
        plan("name = 'x'\n[base]\nframes = 3\n'trace.epsilon' = 0.5\nphotons = '8x8'\n")
            .runs[0]
            .hash;
    EXPECT_EQ(plan("name = 'y'\nrepeats = 4\n[base]\nphotons = '8x8'\nframes = 3\nepsilon = 5e-1\n")
                  .runs[0]
                  .hash,
              hash);
    EXPECT_EQ(plan("name = 'z'\n[base]\ntrace = {epsilon = 0.5}\nframes = 3\n"
                   "[permute]\nemit.photons = ['8x8']\n")
                  .runs[0]
                  .hash,
              hash);
}

TEST_F(Hash, OfADefaultIsTheSameWhetherItIsWrittenOrNot) {
    EXPECT_EQ(plan("name = 'x'\n[base]\nepsilon = 0.01\nseed = 1\n").runs[0].hash,
              plan("name = 'x'\n").runs[0].hash);
}

TEST_F(Hash, ChangesWithEverySetting) {
    const std::string hash = plan("name = 'x'\n").runs[0].hash;
    for (const char* setting :
         {"technique = 'cube'", "size = '64x49'", "frames = 9", "warmup = 2", "seed = 2",
          "precise = true", "ledger = false", "time = 0.25", "reference = 'auto'",
          "reference_photons = 1001", "disable = ['sprites']", "trace = 'march'", "epsilon = 0.02",
          "width = 1", "photons = '256x255'"}) {
        EXPECT_NE(plan(std::string("name = 'x'\n[base]\n") + setting + "\n").runs[0].hash, hash)
            << setting;
    }
}

TEST_F(Hash, ChangesWithTheSceneFileAndNotWithItsFolder) {
    const std::string hash = plan("name = 'x'\n").runs[0].hash;
    std::filesystem::create_directory(folder / "elsewhere");
    std::filesystem::copy_file(folder / "empty.toml", folder / "elsewhere/empty.toml");
    EXPECT_EQ(plan("name = 'x'\n[base]\nscene = 'elsewhere/empty.toml'\n").runs[0].hash, hash);
    static_cast<void>(folder.file("empty.toml", "name = 'empty'\ntime = 0.5\n# another\n"));
    EXPECT_NE(plan("name = 'x'\n").runs[0].hash, hash);
}

}  // namespace
}  // namespace kaustik::experiment
