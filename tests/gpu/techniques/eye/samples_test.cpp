// SPDX-License-Identifier: MIT
// eye.samples on the device: the picture is the mean over the pixels' areas, against the closed
// form of what a silhouette covers of each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

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
    const std::string name = samples > 1 ? "compose.samples" : "compose.receiver_radiance";
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

// Still water lets the same irradiance through everywhere.
TEST(EyeSamples, LeaveAnEvenCausticAsItIs) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Settings settings = {{"emit.photons", "64x64"}};
    Settings more = settings;
    more.emplace_back("eye.samples", "5");
    const std::string name = "compose.samples_caustic";
    const Frame one(scene, 64, 48, settings, {"caustic.irradiance"});
    const Frame five(scene, 64, 48, more, {name, "compose.samples"}, true);
    EXPECT_EQ(five.countNotFinite("compose.samples"), 0u);
    EXPECT_EQ(five.countNotFinite(name), 0u);
    const Texels before = one.read("caustic.irradiance");
    const Texels after = five.read(name);
    double largest = 0.0;
    double sumBefore = 0.0;
    double sumAfter = 0.0;
    for (int y = 16; y < 32; ++y) {
        for (int x = 16; x < 48; ++x) {
            largest = std::max(largest, static_cast<double>(before.rgb(x, y).g));
            sumBefore += static_cast<double>(before.rgb(x, y).g);
            sumAfter += static_cast<double>(after.rgb(x, y).g);
        }
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_NEAR(sumAfter / sumBefore, 1.0, 1e-3);
}

class AFrameOfSamples : public testing::Test {
  protected:
    [[nodiscard]] RenderSettings settings(const std::string& samples,
                                          const std::string& temporal = "none") const {
        RenderSettings settings = run::makeSettings({.technique = "screen_space_photons",
                                                     .assignments = {{"eye.samples", samples, ""},
                                                                     {"temporal", temporal, ""},
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
