// SPDX-License-Identifier: MIT
// What must hold for any mixture of nodes and settings, of mixtures that have all pairs of nodes
// and of what others have been found to do wrong. More are drawn by `mixtures --count 1000`, and
// costly ends of ranges tried by `mixtures --ends`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "framework/gl/context.h"
#include "tests/mixtures/finds.h"
#include "tests/mixtures/pairs.h"
#include "tests/mixtures/test_bench.h"

namespace kaustik::mixtures {
namespace {

void expectNoProblem(const Mixture& mixture, const std::string& check, const std::string& problem) {
    if (problem.empty()) return;
    if (const KnownFind* known = knownFindOf(mixture, check)) {
        std::cout << fmt::format("known: {} [{}] {}\n", known->what, check, lineOf(mixture));
        return;
    }
    ADD_FAILURE() << '[' << check << "] " << problem << '\n' << lineOf(mixture);
}

// One of many, each of which takes a part of the list.
constexpr int kParts = 8;
class EveryPairOfNodes : public testing::TestWithParam<int> {};

TEST_P(EveryPairOfNodes, RendersWhatHoldsForAll) {
    const std::vector<Mixture>& mixtures = mixturesOfAllPairs();
    for (std::size_t i = static_cast<std::size_t>(GetParam()); i < mixtures.size(); i += kParts) {
        const Mixture& mixture = mixtures[i];
        Refusal refusal;
        const std::optional<Rendered> rendered = renderForChecks(testBench(), mixture, refusal);
        if (!rendered) {
            ADD_FAILURE() << refusal.message << '\n' << lineOf(mixture);
            continue;
        }
        for (const Check& check : checksOfAFrame())
            expectNoProblem(mixture, check.name, check.run(testBench(), *rendered).problem);
        // In turn one of those that take another frame.
        Random random(i, 0);
        const std::vector<Check> further = drawnChecks(random, *rendered);
        const Check& check = further[(i / kParts) % further.size()];
        expectNoProblem(mixture, check.name, check.run(testBench(), *rendered).problem);
    }
}

INSTANTIATE_TEST_SUITE_P(Mixtures, EveryPairOfNodes, testing::Range(0, kParts));

TEST(AnswersThatDoNotFit, AreRefusedWithASettingThatHelps) {
    for (const Apart& apart : answersApart()) {
        Mixture mixture = smallMixture("lights");
        // Either may need other nodes than the usual ones, but for which it would be refused.
        for (const Answer& answer : {apart.one, apart.other}) {
            if (answer == Answer{"reconstruct.space", "light"}) mixture.set("gather", "project");
            if (answer == Answer{"reconstruct.space", "cube"}) mixture.set("gather", "cube");
            if (answer == Answer{"gather", "project"}) mixture.set("reconstruct.space", "light");
            if (answer == Answer{"gather", "cube"}) mixture.set("reconstruct.space", "cube");
        }
        mixture.set(apart.one.first, apart.one.second);
        mixture.set(apart.other.first, apart.other.second);
        Refusal refusal;
        EXPECT_FALSE(renderForChecks(testBench(), mixture, refusal)) << lineOf(mixture);
        expectNoProblem(mixture, "refusal", faultOf(testBench(), mixture, refusal));
    }
}

TEST(MemoryLimits, ChangeNoBitOrAreKnownTo) {
    // Smaller maps and faces, which the report says, and fewer layers of the same.
    const std::vector<std::string> others = {"reconstruct.map_memory", "around.cubes.memory"};
    const std::vector<std::string> neutral = neutralNames();
    for (const params::NamedField& parameter : paramsOf(smallMixture("ball")).all()) {
        if (parameter.field.unit != "MiB") continue;
        const std::string& name = parameter.fullName;
        EXPECT_TRUE(std::count(neutral.begin(), neutral.end(), name) +
                        std::count(others.begin(), others.end(), name) ==
                    1)
            << name;
    }
}

TEST(EveryKnownFind, IsStillThere) {
    for (const KnownFind& known : knownFinds()) {
        const Mixture mixture = mixtureOf(known.line);
        EXPECT_FALSE(problemOf(testBench(), mixture, known.check).empty())
            << "This is mended: take it to mendedFinds().\n"
            << known.line << " [" << known.check << ']';
        EXPECT_EQ(knownFindOf(mixture, known.check), &known) << known.line;
    }
}

TEST(EveryMendedFind, IsRight) {
    for (const MendedFind& mended : mendedFinds()) {
        const Mixture mixture = mixtureOf(mended.line);
        expectNoProblem(mixture, mended.check, problemOf(testBench(), mixture, mended.check));
    }
}

}  // namespace

Bench& testBench() {
    static const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(true);
    static Bench instance(*context);
    return instance;
}

}  // namespace kaustik::mixtures
