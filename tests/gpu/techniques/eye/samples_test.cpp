// SPDX-License-Identifier: MIT
// eye.samples on the device: the picture is the mean over the pixels' areas, against the closed
// form of what a silhouette covers of each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "framework/core/error.h"
#include "framework/report/seen_receivers.h"
#include "framework/run/session.h"
#include "framework/run/settings.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/silhouette.h"

namespace kaustik::test {
namespace {

// A black ball before an environment of 1 W/m²/sr: of each pixel's radiance what the ball covers is
// missing. Nothing in the scene is specular.
scene::Scene blackBall() {
    return ballBeforeEnvironment("type = 'lambertian'\nalbedo = 0");
}

// The largest difference from the share of the environment that a pixel sees, W/m²/sr.
double worstError(const scene::Scene& scene, int samples) {
    const std::string name = samples > 1 ? "compose.pixels" : "compose.receiver_radiance";
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
            worst =
                std::max(worst, std::abs(radiance.rgb(x, y).g - (1.0 - coveredByBall(ray, side))));
        }
    }
    return worst;
}

TEST(EyeSamples, GiveEachPixelTheShareThatASilhouetteCoversOfIt) {
    const scene::Scene scene = blackBall();
    EXPECT_GT(worstError(scene, 1), 0.45);
    // Of a grid of points an edge passes by half a row at most: it is nearly straight in a pixel.
    EXPECT_LT(worstError(scene, 4), 0.6 / 2.0);
    EXPECT_LT(worstError(scene, 16), 0.6 / 4.0);
    EXPECT_LT(worstError(scene, 64), 0.6 / 8.0);
}

// Whatever is an output is the mean of that of the finer picture, under the same name.
TEST(EyeSamples, GiveTheMeanOfAFinerPicture) {
    const scene::Scene scene = scene::loadScene("glossy-table");
    constexpr int kWidth = 64;
    constexpr int kHeight = 48;
    const std::vector<std::string> saved = {"caustic.irradiance", "caustic.radiance", "display"};
    const Settings settings = {{"emit.photons", "64x64"}, {"shadow.map.size", "256"}};
    Settings more = settings;
    more.emplace_back("eye.samples", "9");
    const Frame nine(scene, kWidth, kHeight, more, saved, true);
    const Frame fine(scene, 3 * kWidth, 3 * kHeight, settings, saved);
    EXPECT_EQ(nine.read("display").width, kWidth);
    for (const std::string name : {"caustic.irradiance", "caustic.radiance"}) {
        SCOPED_TRACE(name);
        const Texels mean = nine.read(name);
        const Texels finer = fine.read(name);
        ASSERT_EQ(mean.width, kWidth);
        ASSERT_EQ(mean.height, kHeight);
        EXPECT_EQ(nine.countNotFinite(name), 0u);
        double lit = 0.0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                double sum = 0.0;
                for (int i = 0; i < 9; ++i)
                    sum += finer.rgb(3 * x + i % 3, 3 * y + i / 3).g;
                EXPECT_NEAR(mean.rgb(x, y).g, sum / 9.0, 1e-4 * sum / 9.0) << x << " " << y;
                lit += sum;
            }
        }
        EXPECT_GT(lit, 0.0);
    }
}

TEST(EyeSamples, OfAPixelSeeReceiversTogether) {
    // Two pixels of two by two samples; depth and area. A mirror's depth is negative.
    const std::vector<float> samples = {1.0f, 0.1f, 0.0f, 0.0f, 0.0f, 0.0f, -2.0f, 5.0f,
                                        3.0f, 0.2f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f,  0.0f};
    const std::vector<float> pixels = report::seenReceivers(samples, 4, 2);
    ASSERT_EQ(pixels.size(), 4u);
    EXPECT_GT(pixels[0], 0.0f);
    EXPECT_FLOAT_EQ(pixels[1], 0.3f);
    EXPECT_EQ(pixels[2], 0.0f);
    EXPECT_EQ(pixels[3], 0.0f);
}

TEST(EyeSamples, AreSquaresAndNoneInTiles) {
    const scene::Scene scene = scene::loadScene("pool");
    const Registry registry = registerAll();
    const auto with = [&](const char* samples) {
        return run::makeSettings({.technique = "screen_space_photons",
                                  .assignments = {{"eye.samples", samples, "test"}}},
                                 registry);
    };
    try {
        static_cast<void>(with("5"));
        ADD_FAILURE() << "5 are no square";
    } catch (const ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find("it takes 1, 4, 9"), std::string::npos);
    }
    RenderSettings settings = with("4");
    settings.tiles = std::make_shared<const TileFrame>();
    Renderer renderer(context(), registry, scene, settings);
    EXPECT_THROW(renderer.build(Purpose::picture), ConfigError);
}

TEST(EyeSamples, ChangeWithTheSettings) {
    const Registry registry = registerAll();
    scene::Scene scene = scene::loadScene("glass-sphere");
    const auto with = [&](const char* samples) {
        RenderSettings settings = run::makeSettings({.technique = "screen_space_photons",
                                                     .assignments = {{"eye.samples", samples, ""},
                                                                     {"emit.photons", "32x32", ""},
                                                                     {"trace", "march", ""}}},
                                                    registry);
        run::setSize(settings, {64, 48});
        return settings;
    };
    const auto picture = [](const run::Session& session) {
        const Renderer& renderer = session.renderer();
        return renderer.texture(renderer.outputs().picture.radiance).read();
    };
    run::Session session(context(), registry, scene, with("4"));
    static_cast<void>(session.render({.frames = 1}));
    const std::vector<float> four = picture(session);
    session.change(with("1"));
    static_cast<void>(session.render({.frames = 1}));
    run::Session fresh(context(), registry, scene, with("1"));
    static_cast<void>(fresh.render({.frames = 1}));
    EXPECT_EQ(picture(session), picture(fresh));
    EXPECT_EQ(picture(session).size(), four.size());
    EXPECT_NE(picture(session), four);
}

}  // namespace
}  // namespace kaustik::test
