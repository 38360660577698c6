// SPDX-License-Identifier: MIT
#include "framework/run/session.h"

#include <gtest/gtest.h>

#include "framework/core/error.h"
#include "framework/run/settings.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

using run::FrameSeries;

class ASession : public testing::Test {
  protected:
    [[nodiscard]] RenderSettings settings(const std::string& tracer = "march") const {
        RenderSettings settings =
            run::makeSettings({.technique = "screen_space_photons",
                               .assignments = {{"trace", tracer, "test"},
                                               {"emit.photons", "32x32", "test"},
                                               {"shadow.map.size", "64", "test"}}},
                              registry_);
        run::setSize(settings, {64, 48});
        return settings;
    }
    [[nodiscard]] static std::vector<float> picture(const run::Session& session) {
        const Renderer& renderer = session.renderer();
        return renderer.texture(renderer.outputs().picture.radiance).read();
    }

    Registry registry_ = registerAll();
    scene::Scene scene_ = sceneFromText(kWavyWater);
};

TEST_F(ASession, TimesTheFramesAfterTheWarmUpAndLosesNone) {
    for (const bool isPrecise : {false, true}) {
        run::Session session(context(), registry_, scene_, settings(), {.isPrecise = isPrecise});
        int told = 0;
        const auto rendered = session.render({.frames = 9, .warmup = 2},
                                             {{}, [&](int done) { EXPECT_EQ(done, ++told); }});
        EXPECT_TRUE(rendered.isWhole);
        EXPECT_EQ(told, 11);
        EXPECT_EQ(rendered.times.size(), 9u);
        EXPECT_EQ(rendered.times.front().frame, 2u) << "the warm-up comes first";
        EXPECT_EQ(session.record().frames.size(), 9u);
        EXPECT_EQ(session.record().warmup, 2);
    }
}

TEST_F(ASession, OfASeriesThatIsEndedHasTheWholeFrames) {
    run::Session session(context(), registry_, scene_, settings());
    int done = 0;
    const auto shouldContinue = [&](std::size_t step) { return done < 3 || step < 2; };
    const auto rendered =
        session.render({.frames = 5, .warmup = 1}, {shouldContinue, [&](int all) { done = all; }});
    EXPECT_FALSE(rendered.isWhole);
    EXPECT_EQ(rendered.times.size(), 2u);
    EXPECT_FALSE(session.hasFrame());
    EXPECT_EQ(session.render({.frames = 1}).times.size(), 1u);
    EXPECT_EQ(session.record().frames.size(), 3u);
    EXPECT_TRUE(session.hasFrame());
}

TEST_F(ASession, ForgetsTimesWithOtherSettingsAndNotWithAnotherScene) {
    run::Session session(context(), registry_, scene_, settings(), {.framesKept = 4});
    session.render({.frames = 3});
    session.setTime(0.5);
    session.render({.frames = 3});
    EXPECT_EQ(session.record().frames.size(), 4u) << "the newest";
    session.change(settings("hierarchical"));
    EXPECT_FALSE(session.hasFrame());
    session.render({.frames = 1});
    EXPECT_EQ(session.record().frames.size(), 1u);
}

TEST_F(ASession, ShowsWhatOneOfTheLastTimeAloneShows) {
    run::Session moving(context(), registry_, scene_, settings());
    const FrameSeries series{
        .frames = 3, .warmup = 1, .firstSeconds = 0.25, .timeStepSeconds = 0.5};
    moving.render(series);
    EXPECT_EQ(scene_.timeSeconds, 1.25);
    EXPECT_EQ(moving.record().timeStepSeconds, 0.5);
    scene::Scene still = sceneFromText(kWavyWater);
    run::Session single(context(), registry_, still, settings());
    single.render({});
    const std::vector<float> first = picture(single);
    single.render({.firstSeconds = 1.25});
    EXPECT_EQ(picture(moving), picture(single));
    EXPECT_NE(picture(moving), first);
}

TEST_F(ASession, RendersForAnotherPurposeAndGoesBack) {
    run::Session session(context(), registry_, scene_, settings());
    session.render({});
    const std::vector<float> whole = picture(session);
    EXPECT_TRUE(session.renderFor(Purpose::view, {}, params::Extent{32, 24}));
    EXPECT_FALSE(session.hasFrame());
    EXPECT_EQ(picture(session).size() * 4, whole.size());
    EXPECT_TRUE(session.renderAgain());
    EXPECT_EQ(picture(session), whole);
    EXPECT_EQ(session.record().frames.size(), 1u) << "such frames are not timed";
}

TEST_F(ASession, IsAsBeforeWhereSettingsCannotBe) {
    run::Session session(context(), registry_, scene_, settings());
    session.render({.frames = 2});
    const std::vector<float> before = picture(session);
    RenderSettings impossible = settings("hierarchical");
    impossible.disabledPasses = {"no.such.pass"};
    EXPECT_THROW(session.adopt(impossible), ConfigError);
    EXPECT_EQ(session.settings().params.choice("trace"), "march");
    EXPECT_EQ(session.record().frames.size(), 2u);
    EXPECT_TRUE(session.renderAgain());
    EXPECT_EQ(picture(session), before);
}

}  // namespace
}  // namespace kaustik::test
