// SPDX-License-Identifier: MIT
// eye.samples on the device: the picture is the mean over the pixels' areas, against the closed
// form of what a silhouette covers of each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/core/error.h"
#include "framework/run/session.h"
#include "framework/run/settings.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// A black ball before an environment of 1 W/m²/sr: of each pixel's radiance what the ball covers is
// missing. Nothing in the scene is specular.
constexpr double kDistance = 4.0;
constexpr double kRadius = 1.0;
scene::Scene blackBall() {
    return sceneFromText(fmt::format(R"(
name = 'ball'
background_radiance = 1
[camera]
position = [0, 0, {}]
target = [0, 0, 0]
vertical_fov_degrees = 45
[[light]]
name = "sun"
type = "directional"
irradiance = 1
direction = [0, -1, 0]
[[material]]
name = "black"
type = "lambertian"
albedo = 0
[[object]]
name = "ball"
shape = "sphere"
material = "black"
radius = {}
segments = 128
)",
                                     kDistance, kRadius));
}

// Of a pixel whose middle is seen along `ray`; `side`: what it measures at a depth of 1 m.
double covered(const glm::dvec2& ray, double side) {
    constexpr int kParts = 32;
    // The cone around the ball: its tangent of the half-angle.
    const double edge = kRadius / std::sqrt(kDistance * kDistance - kRadius * kRadius);
    int inside = 0;
    for (int i = 0; i < kParts * kParts; ++i) {
        const glm::dvec2 offset((i % kParts + 0.5) / kParts - 0.5,
                                (i / kParts + 0.5) / kParts - 0.5);
        inside += glm::length(ray + side * offset) < edge ? 1 : 0;
    }
    return static_cast<double>(inside) / (kParts * kParts);
}

// The largest difference from the share of the environment that a pixel sees, W/m²/sr.
double worstError(const scene::Scene& scene, int samples) {
    const std::string name = "compose.receiver_radiance";
    const Frame frame(scene, 97, 71,
                      {{"eye.samples", fmt::format("{}", samples)}, {"emit.photons", "8x8"}},
                      {name}, true);
    const Texels radiance = frame.read(name);
    const double side = frame.view().footprintPerMeter();
    double worst = 0.0;
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            const glm::dvec2 ray(side * (x + 0.5 - 0.5 * radiance.width),
                                 side * (y + 0.5 - 0.5 * radiance.height));
            worst = std::max(worst, std::abs(radiance.rgb(x, y).g - (1.0 - covered(ray, side))));
        }
    }
    return worst;
}

TEST(EyeSamples, GiveEachPixelTheShareThatASilhouetteCoversOfIt) {
    const scene::Scene scene = blackBall();
    EXPECT_GT(worstError(scene, 1), 0.45);
    // An edge splits points that are evenly spread to two or three of them.
    EXPECT_LT(worstError(scene, 4), 2.0 / 4.0);
    EXPECT_LT(worstError(scene, 16), 3.0 / 16.0);
    EXPECT_LT(worstError(scene, 64), 4.0 / 64.0);
}

// Of four samples the last goes through a place that is a pixel's middle where there are four times
// as many a side.
TEST(EyeSamples, SeeAndLightWhatAFinerPictureHasThere) {
    const scene::Scene scene = scene::loadScene("glossy-table");
    constexpr int kWidth = 80;
    constexpr int kHeight = 60;
    const std::vector<std::string> saved = {"direct.irradiance", "eye.receiver"};
    const Settings settings = {{"shadow", "rays"}, {"emit.photons", "8x8"}, {"view", "interface"}};
    Settings more = settings;
    more.emplace_back("eye.samples", "4");
    const Frame four(scene, kWidth, kHeight, more, saved, true);
    const Frame fine(scene, 4 * kWidth, 4 * kHeight, settings, saved);
    const glm::dvec2 offset = four.renderer().view().offsetPixels;
    ASSERT_GT(glm::length(offset), 0.3);
    const glm::ivec2 part(glm::round(4.0 * (offset + 0.5) - 0.5));
    ASSERT_LT(glm::length((glm::dvec2(part) + 0.5) / 4.0 - 0.5 - offset), 1e-6);
    const auto share = [&](const std::string& name, const glm::ivec2& of) {
        const Texels coarse = four.read(name);
        const Texels finer = fine.read(name);
        int same = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double a = static_cast<double>(coarse.at(x, y, 0));
                const double b = static_cast<double>(finer.at(4 * x + of.x, 4 * y + of.y, 0));
                same += std::abs(a - b) <= 1e-4 * std::max(std::abs(a), std::abs(b)) ? 1 : 0;
            }
        }
        return static_cast<double>(same) / (kWidth * kHeight);
    };
    for (const std::string& name : saved) {
        SCOPED_TRACE(name);
        EXPECT_GT(share(name, part), 0.995);
        EXPECT_LT(share(name, {3 - part.x, 3 - part.y}), 0.9);
    }
}

// What several rays a pixel see of a caustic is nearer to its mean over the pixels than one is.
TEST(EyeSamples, BringACausticToItsMeanOverThePixels) {
    constexpr int kSide = 4;
    for (const std::string technique : {"caustic_map", "screen_space_photons"}) {
        SCOPED_TRACE(technique);
        const scene::Scene scene = scene::loadScene("ring");
        const Settings settings = {{"emit.photons", "128x128"}, {"shadow.map.size", "64"}};
        Settings more = settings;
        more.emplace_back("eye.samples", "16");
        const std::vector<std::string> saved = {"caustic.irradiance"};
        const Frame one(scene, 80, 60, settings, saved, false, technique);
        const Frame sixteen(scene, 80, 60, more, saved, true, technique);
        const Frame fine(scene, kSide * 80, kSide * 60, settings, saved, false, technique);
        EXPECT_EQ(sixteen.countNotFinite("caustic.irradiance"), 0u);
        const Texels truth = fine.causticIrradiance();
        const auto error = [&](const Texels& caustic) {
            double squares = 0.0;
            for (int y = 0; y < 60; ++y) {
                for (int x = 0; x < 80; ++x) {
                    double mean = 0.0;
                    for (int i = 0; i < kSide * kSide; ++i)
                        mean += truth.rgb(kSide * x + i % kSide, kSide * y + i / kSide).g;
                    const double off = caustic.rgb(x, y).g - mean / (kSide * kSide);
                    squares += off * off;
                }
            }
            return squares;
        };
        const double ofOne = error(one.causticIrradiance());
        const double ofSixteen = error(sixteen.causticIrradiance());
        RecordProperty(technique + "_percent", static_cast<int>(100.0 * ofSixteen / ofOne));
        EXPECT_LT(ofSixteen, 0.5 * ofOne);
    }
}

TEST(EyeSamples, AreRefusedInTilesAndSaidByAFilterOverTime) {
    const scene::Scene scene = scene::loadScene("pool");
    const Frame frame(scene, 32, 24, {{"eye.samples", "2"}, {"temporal", "reproject"}});
    const std::vector<std::string>& warnings = frame.renderer().warnings();
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
        return warning.find("2 samples of eye.samples") != std::string::npos;
    }));

    const Registry registry = registerAll();
    RenderSettings settings = run::makeSettings(
        {.technique = "screen_space_photons", .assignments = {{"eye.samples", "2", "test"}}},
        registry);
    settings.tiles = std::make_shared<const TileFrame>();
    Renderer renderer(context(), registry, scene, settings);
    EXPECT_THROW(renderer.build(Purpose::picture), ConfigError);
}

class AFrameOfSamples : public testing::Test {
  protected:
    [[nodiscard]] RenderSettings settings(const std::string& samples) const {
        RenderSettings settings = run::makeSettings({.technique = "screen_space_photons",
                                                     .assignments = {{"eye.samples", samples, ""},
                                                                     {"emit.photons", "32x32", ""},
                                                                     {"trace", "march", ""}}},
                                                    registry_);
        run::setSize(settings, {64, 48});
        return settings;
    }
    [[nodiscard]] static std::vector<float> picture(const run::Session& session) {
        const Renderer& renderer = session.renderer();
        return renderer.texture(renderer.outputs().picture.radiance).read();
    }

    Registry registry_ = registerAll();
    scene::Scene scene_ = scene::loadScene("glass-sphere");
};

TEST_F(AFrameOfSamples, IsTimedAsOne) {
    for (const bool isPrecise : {false, true}) {
        run::Session session(context(), registry_, scene_, settings("6"), {.isPrecise = isPrecise});
        const auto rendered = session.render({.frames = 2, .warmup = 1});
        ASSERT_EQ(rendered.times.size(), 2u);
        for (const gl::PassTime& pass : rendered.times.front().passes)
            EXPECT_EQ(pass.runs % 6, 0);
        EXPECT_EQ(session.record().timing.droppedFrames, 0u);
    }
}

TEST_F(AFrameOfSamples, IsTheSameWhenItIsRenderedAgain) {
    run::Session session(context(), registry_, scene_, settings("3"));
    static_cast<void>(session.render({.frames = 1}));
    const std::vector<float> first = picture(session);
    EXPECT_TRUE(session.renderAgain());
    EXPECT_EQ(picture(session), first);
    // Also after one that was ended between two samples.
    int calls = 0;
    const std::size_t steps = session.record().stepNames.size();
    EXPECT_FALSE(session.renderAgain(
        [&](std::size_t) { return ++calls < static_cast<int>(steps + steps / 2); }));
    EXPECT_TRUE(session.renderAgain());
    EXPECT_EQ(picture(session), first);
    session.change(settings("1"));
    static_cast<void>(session.render({.frames = 1}));
    const std::vector<float> one = picture(session);
    EXPECT_NE(one, first);
    run::Session fresh(context(), registry_, scene_, settings("1"));
    static_cast<void>(fresh.render({.frames = 1}));
    EXPECT_EQ(one, picture(fresh));
}

}  // namespace
}  // namespace kaustik::test
