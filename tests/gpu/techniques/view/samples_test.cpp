// SPDX-License-Identifier: MIT
// view.samples on the device: several rays of the eye a pixel, against the closed form of what a
// silhouette covers of each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "framework/scene/files/scene_file.h"
#include "techniques/eye_rays/view_passes.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/silhouette.h"

namespace kaustik::test {
namespace {

const std::vector<std::string> kNodes = {"refraction", "image_space", "interface"};

TEST(SamplesOfPixel, AreOneInEachColumnAndRowAroundTheMiddle) {
    for (const int count : {1, 2, 3, 4, 5, 8, 9, 16, 64}) {
        SCOPED_TRACE(count);
        const std::vector<glm::vec2> samples = samplesOfPixel(count);
        ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));
        glm::vec2 sum(0.0f);
        std::set<int> columns;
        std::set<int> rows;
        for (const glm::vec2& sample : samples) {
            EXPECT_LT(std::max(std::abs(sample.x), std::abs(sample.y)), 0.5f);
            sum += sample;
            columns.insert(static_cast<int>((sample.x + 0.5f) * static_cast<float>(count)));
            rows.insert(static_cast<int>((sample.y + 0.5f) * static_cast<float>(count)));
        }
        EXPECT_EQ(columns.size(), samples.size());
        EXPECT_EQ(rows.size(), samples.size());
        // Roundings of 64 numbers below 1.
        EXPECT_LT(std::max(std::abs(sum.x), std::abs(sum.y)), 1e-5f);
        const bool hasMiddle =
            std::find(samples.begin(), samples.end(), glm::vec2(0.0f)) != samples.end();
        EXPECT_EQ(hasMiddle, count % 2 == 1);
    }
}

// A mirror that reflects half, before an environment of 1 W/m²/sr: of each pixel's radiance half of
// what the ball covers is missing. Where its edge lies is known exactly.
scene::Scene mirrorBall() {
    return ballBeforeEnvironment("type = 'mirror'\nreflectance = 0.5");
}

struct EdgeError {
    double rms = 0.0;  // W/m²/sr, of pixels that the edge crosses
    double worst = 0.0;
    double elsewhere = 0.0;  // the largest of the others
};
EdgeError errorAtEdge(const scene::Scene& scene, const std::string& node, int samples) {
    const Frame frame(
        scene, 96, 72,
        {{"view", node}, {"view.samples", fmt::format("{}", samples)}, {"emit.photons", "8x8"}},
        {"view.radiance"}, true);
    const Texels radiance = frame.read("view.radiance");
    const double side = frame.view().footprintPerMeter();
    EdgeError error;
    double squares = 0.0;
    int pixels = 0;
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            const glm::dvec2 ray(side * (x + 0.5 - 0.5 * radiance.width),
                                 side * (y + 0.5 - 0.5 * radiance.height));
            const double share = coveredByBall(ray, side);
            const double off = std::abs(radiance.rgb(x, y).g - (1.0 - 0.5 * share));
            if (share > 0.0 && share < 1.0) {
                squares += off * off;
                ++pixels;
                error.worst = std::max(error.worst, off);
            } else {
                error.elsewhere = std::max(error.elsewhere, off);
            }
        }
    }
    EXPECT_GT(pixels, 100);
    error.rms = std::sqrt(squares / std::max(pixels, 1));
    return error;
}

TEST(ViewSamples, GiveEachPixelTheShareThatASilhouetteCoversOfIt) {
    const scene::Scene scene = mirrorBall();
    for (const std::string& node : kNodes) {
        SCOPED_TRACE(node);
        const EdgeError one = errorAtEdge(scene, node, 1);
        const EdgeError four = errorAtEdge(scene, node, 4);
        const EdgeError sixteen = errorAtEdge(scene, node, 16);
        RecordProperty("one_ppm", static_cast<int>(1e6 * one.rms));
        RecordProperty("four_ppm", static_cast<int>(1e6 * four.rms));
        RecordProperty("sixteen_ppm", static_cast<int>(1e6 * sixteen.rms));
        // All or nothing of half of the light: evenly between 0 and a quarter.
        EXPECT_NEAR(one.rms, 0.25 / std::sqrt(3.0), 0.03);
        // An edge splits points that are evenly spread to two or three of them.
        EXPECT_LT(four.worst, 0.5 * 2.0 / 4.0);
        EXPECT_LT(sixteen.worst, 0.5 * 3.0 / 16.0);
        EXPECT_LT(four.rms, 0.6 * one.rms);
        EXPECT_LT(sixteen.rms, 0.2 * one.rms);
        // A ball of 128 segments is 0.3 mm smaller than its radius, a pixel there 45 mm: no sample
        // lies between.
        for (const EdgeError& error : {one, four, sixteen})
            EXPECT_LT(error.elsewhere, 1e-5);
    }
}

TEST(ViewSamples, LeaveTheRayThroughTheMiddleAsItIs) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const std::vector<std::string> saved = {"view.exit_position", "view.exit_direction",
                                            "view.radiance"};
    for (const std::string& node : kNodes) {
        SCOPED_TRACE(node);
        const Settings settings = {{"view", node}, {"emit.photons", "8x8"}};
        Settings more = settings;
        more.emplace_back("view.samples", "4");
        const Frame one(scene, 64, 48, settings, saved);
        const Frame four(scene, 64, 48, more, saved, true);
        EXPECT_EQ(one.read("view.exit_position").values, four.read("view.exit_position").values);
        EXPECT_EQ(one.read("view.exit_direction").values, four.read("view.exit_direction").values);
        EXPECT_EQ(four.countNotFinite("view.radiance"), 0u);
        const Texels before = one.read("view.radiance");
        const Texels after = four.read("view.radiance");
        int changed = 0;
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x)
                changed += glm::distance(before.rgb(x, y), after.rgb(x, y)) > 1e-3 ? 1 : 0;
        }
        EXPECT_GT(changed, 100);
    }
}

TEST(ViewSamples, SayThatTheyHaveNoEffectWhereNothingIsSpecular) {
    const scene::Scene scene = scene::loadScene("tree");
    for (const std::string& node : kNodes) {
        const Frame frame(scene, 16, 12, {{"view", node}, {"view.samples", "4"}});
        const std::vector<std::string>& warnings = frame.renderer().warnings();
        EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
            return warning.starts_with("view.samples has no effect");
        })) << node;
    }
}

}  // namespace
}  // namespace kaustik::test
