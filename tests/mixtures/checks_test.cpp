// SPDX-License-Identifier: MIT
// Each check finds fault with a frame that has one, and with none that has not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/mixtures/checks.h"
#include "tests/mixtures/finds.h"
#include "tests/mixtures/test_bench.h"

namespace kaustik::mixtures {
namespace {

using Fault = std::function<void(Shot&)>;

Image& irradianceOf(Shot& shot) {
    return shot.outputs.images.front().image;
}

// The brightest value, so that a share of it is one of the largest.
float& brightest(Image& image) {
    return *std::max_element(image.values.begin(), image.values.end());
}

Fault brighter(float factor) {
    return [factor](Shot& shot) {
        for (float& value : irradianceOf(shot).values)
            value *= factor;
        // Another frame does not have this fault: no advice is to seem to mend it.
        shot.warnings.clear();
        shot.limits.clear();
    };
}

Fault brighterInOneValue(float factor) {
    return [factor](Shot& shot) { brightest(irradianceOf(shot)) *= factor; };
}

void expectSeen(const char* name, const Rendered& right, const Fault& fault) {
    SCOPED_TRACE(name);
    const Check check = checkOf(name);
    const Verdict verdict = check.run(testBench(), right);
    EXPECT_TRUE(verdict.isMade);
    EXPECT_EQ(verdict.problem, "");
    Rendered wrong = right;
    fault(wrong.shot);
    EXPECT_NE(check.run(testBench(), wrong).problem, "");
}

TEST(EveryCheck, SeesAFaultOfItsKind) {
    Refusal refusal;
    const std::optional<Rendered> right =
        renderForChecks(testBench(), smallMixture("ball"), refusal);
    ASSERT_TRUE(right) << refusal.message;
    const Rendered& ball = *right;
    expectSeen("finite", ball, [](Shot& shot) { shot.notFinite.emplace_back("hits.flux"); });
    expectSeen("finite", ball, [](Shot& shot) {
        shot.display.values.back() = std::numeric_limits<float>::quiet_NaN();
    });
    expectSeen("sign", ball, [](Shot& shot) { irradianceOf(shot).values.front() = -1e-9f; });
    expectSeen("sign", ball, [](Shot& shot) { shot.picture.values.front() = -1e-9f; });
    expectSeen("balance", ball,
               [](Shot& shot) { shot.ledger.watts[transport::kAccountDeposited] *= 1.00003; });
    expectSeen("stored", ball, [](Shot& shot) { shot.shownWatts *= 1.00003; });
    expectSeen("energy", ball, brighter(0.95f));
    expectSeen("energy", ball, brighter(1.05f));
    expectSeen("bits nothing", ball, [](Shot& shot) {
        float& value = brightest(irradianceOf(shot));
        value = std::nextafter(value, 0.0f);
    });
    expectSeen("bits emit.batch=512", ball,
               [](Shot& shot) { shot.ledger.watts[transport::kAccountDeposited] *= 1.0000001; });
    expectSeen("order 3", ball, brighterInOneValue(1.00001f));
    expectSeen("light 2", ball, brighterInOneValue(1.00001f));
    expectSeen("scale 0.125", ball, brighterInOneValue(1.00001f));
    expectSeen("scale 0.125", ball,
               [](Shot& shot) { shot.ledger.watts[transport::kAccountAbsorbed] += 1.0; });
    expectSeen("scale 100", ball, brighter(1.04f));
    expectSeen("turn 33", ball, brighter(1.05f));
    // The light of one half of the picture in the other one.
    expectSeen("turn 33", ball, [](Shot& shot) {
        Image& image = irradianceOf(shot);
        std::reverse(image.values.begin(), image.values.end());
    });
}

TEST(ARefusal, IsOneSentenceWithASettingThatHelps) {
    Mixture mixture = smallMixture("ball");
    mixture.set("gather", "project");
    Refusal refusal;
    ASSERT_FALSE(renderForChecks(testBench(), mixture, refusal));
    EXPECT_TRUE(refusal.isOfRequest);
    EXPECT_EQ(faultOf(testBench(), mixture, refusal), "");
    const auto isFaulty = [&](const std::string& message) {
        return !faultOf(testBench(), mixture, {message, false, true}).empty();
    };
    EXPECT_TRUE(isFaulty("gather.project takes maps of lights."));
    EXPECT_TRUE(isFaulty("gather.project takes maps of lights; take gather=screen"));
    EXPECT_TRUE(isFaulty("gather.project takes maps of lights; take something else."));
    EXPECT_TRUE(isFaulty("It does not go. Really. Do take gather=screen."));
    // The same refusal again.
    EXPECT_TRUE(isFaulty(refusal.message + " Or take layers.count=3."));
    EXPECT_EQ(faultOf(testBench(), mixture, {"The device has no memory.", true, false}), "");
    EXPECT_NE(faultOf(testBench(), mixture, {"A shader does not compile.", false, false}), "");
}

TEST(AFind, IsMadeSmall) {
    Mixture mixture = smallMixture("ball");
    mixture.set("trace", "lines");
    mixture.set("gather", "project");
    mixture.set("layers.count", "3");
    // That the mixture is not refused for another reason is what matters.
    const auto isRefused = [](const Mixture& tried) {
        Refusal refusal;
        return !renderForChecks(testBench(), tried, refusal);
    };
    ASSERT_TRUE(isRefused(mixture));
    const Mixture small = minimised(mixture, isRefused);
    EXPECT_EQ(lineOf(small),
              "kaustik run tests/mixtures/scenes/ball.toml --size 160x120 --set "
              "emit.photons=64x64 --set gather=project");
}

TEST(AMixture, IsItsLine) {
    Random random(7, 1);
    for (int i = 0; i < 20; ++i) {
        const Mixture mixture = drawMixture(random);
        const Mixture again = mixtureOf(lineOf(mixture));
        EXPECT_EQ(lineOf(again), lineOf(mixture));
        EXPECT_EQ(paramsOf(again).json(), paramsOf(mixture).json());
    }
}

}  // namespace
}  // namespace kaustik::mixtures
