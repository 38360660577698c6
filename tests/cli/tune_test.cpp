// SPDX-License-Identifier: MIT
// kaustik tune, as one uses it: a settings file that `run --merge` takes, what was measured is not
// measured again, and goals that make no sense or that nothing keeps to.
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

class Tune : public CommandLine {
  protected:
    Tune() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }
    [[nodiscard]] Outcome tune(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {
            "tune",  "wavy.toml", "--size", "48x36", "--reference-photons",
            "65536", "--out",     "tuned"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
};

TEST_F(Tune, WritesSettingsThatARunTakes) {
    const Outcome outcome = tune({"--error", "0.2"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("on the front"), std::string::npos) << outcome.out;
    const std::string settings = contents("tuned/tuned.toml");
    EXPECT_NE(settings.find("--error 0.2"), std::string::npos) << settings;
    ASSERT_EQ(run({"run", "wavy.toml", "--size", "48x36", "--frames", "1", "--warmup", "0",
                   "--merge", "tuned/tuned.toml", "--out", "out"})
                  .exitCode,
              0);
    EXPECT_NE(settings.find("\"" + report().at("technique").get<std::string>() + "\""),
              std::string::npos)
        << settings;

    // Once more: nothing is left to be rendered, and the same is chosen.
    const Outcome again = tune({"--error", "0.2"});
    ASSERT_EQ(again.exitCode, 0) << again.err;
    EXPECT_EQ(contents("tuned/tuned.toml"), settings);
    EXPECT_EQ(again.out, outcome.out);

    const Outcome tooSoon = tune({"--time", "0.0001"});
    EXPECT_EQ(tooSoon.exitCode, 1);
    EXPECT_NE(tooSoon.err.find("Nothing that was tried keeps to --time 0.0001"), std::string::npos)
        << tooSoon.err;
}

TEST_F(Tune, RefusesGoalsThatMakeNoSense) {
    expectFailure(tune({}), 2, {"--error", "--time", "one of them"});
    expectFailure(tune({"--error", "0.1", "--time", "5"}), 2, {"one of them"});
    expectFailure(tune({"--error", "-1"}), 2, {"--error: -1 is not above 0"});
    expectFailure(tune({"--time", "0"}), 2, {"--time: 0 ms is not above 0"});
    expectFailure(run({"tune", "nowhere.toml", "--error", "0.1"}), 1, {"nowhere.toml"});
}

}  // namespace
}  // namespace kaustik::test
