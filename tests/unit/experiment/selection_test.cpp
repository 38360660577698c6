// SPDX-License-Identifier: MIT
#include "framework/experiment/selection.h"

#include "tests/unit/experiment/fixture.h"

namespace kaustik::experiment {
namespace {

class Selection : public Experiment {
  protected:
    Selection()
        : plan_(plan("name = 's'\n[[permute]]\ntrace = ['lines', 'march']\n"
                     "'trace.epsilon' = [0.1, 0.25]\n'emit.photons' = ['8x8', '16x16']\n"
                     "[[permute]]\ntechnique = ['cube']\n")) {}

    // The settings of those that are chosen, as "technique trace epsilon photons".
    [[nodiscard]] std::set<std::string> chosen(const std::vector<std::string>& conditions) const {
        const std::set<std::string> hashes = selectRuns(plan_, conditions, "--only");
        std::set<std::string> names;
        for (const PlannedRun& run : plan_.runs) {
            if (!hashes.contains(run.hash)) continue;
            const nlohmann::json& parameters = run.settings.at("parameters");
            names.insert(run.settings.at("technique").get<std::string>() + " " +
                         parameters.at("trace").get<std::string>() + " " +
                         parameters.at("trace.epsilon").dump() + " " +
                         parameters.at("emit.photons").get<std::string>());
        }
        return names;
    }

    [[nodiscard]] std::string refusal(const std::vector<std::string>& conditions) const {
        return test::messageOf<ConfigError>([&] { static_cast<void>(chosen(conditions)); });
    }

    Plan plan_;
};

TEST_F(Selection, TakesTheRunsThatHaveTheValueOfEachKey) {
    EXPECT_EQ(chosen({"trace=march", "emit.photons=8x8"}),
              (std::set<std::string>{"screen march 0.1 8x8", "screen march 0.25 8x8"}));
    EXPECT_EQ(chosen({"technique=cube"}).size(), 1u);
    EXPECT_EQ(chosen({}).size(), 9u);
}

TEST_F(Selection, TakesSeveralValuesOfOneKeyAsAlternatives) {
    EXPECT_EQ(chosen({"trace=lines", "trace=march", "trace.epsilon=0.25", "photons=16x16"}),
              (std::set<std::string>{"screen lines 0.25 16x16", "screen march 0.25 16x16"}));
}

TEST_F(Selection, ComparesNumbersByTheirSizeAndKeysByTheirEnds) {
    EXPECT_EQ(chosen({"epsilon=0.250"}), chosen({"trace.epsilon=2.5e-1"}));
    EXPECT_EQ(chosen({"epsilon=0.250"}).size(), 4u);
}

TEST_F(Selection, RefusesInOneSentenceWhatTheStudyDoesNotVary) {
    EXPECT_NE(refusal({"trace.lines.width=4"}).find("does not vary 'trace.lines.width'"),
              std::string::npos);
    EXPECT_NE(refusal({"tecnique=cube"}).find("did you mean 'technique'?"), std::string::npos)
        << refusal({"tecnique=cube"});
    EXPECT_NE(refusal({"trace=lnies"}).find("has trace = 'lnies'; did you mean 'lines'?"),
              std::string::npos)
        << refusal({"trace=lnies"});
    EXPECT_NE(refusal({"epsilon=0.2"}).find("has trace.epsilon = '0.2'"), std::string::npos);
    EXPECT_NE(refusal({"technique=cube", "trace=march"}).find("all of these values together"),
              std::string::npos);
    for (const char* condition : {"", "trace", "=lines"})
        EXPECT_NE(refusal({condition}).find("is not KEY=VALUE"), std::string::npos) << condition;
}

}  // namespace
}  // namespace kaustik::experiment
