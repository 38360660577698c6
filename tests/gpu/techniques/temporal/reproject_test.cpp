// SPDX-License-Identifier: MIT
// temporal.reproject: what stands still stays as it is, noise is averaged as the weight says, and
// what is new is not averaged with what was there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/scene/files/scene_file.h"
#include "framework/scene/shapes/height_field.h"
#include "tests/gpu/techniques/temporal/film.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

TEST(Temporal, IsLeftOutUnlessItIsAskedFor) {
    Film film(sceneFromText(kWavyWater), 48, 36, {{"emit.photons", "16x16"}});
    film.next();
    for (const std::string& name : film.renderer().graph().resourceNames())
        EXPECT_FALSE(name.starts_with("temporal.")) << name;
}

TEST(Temporal, LeavesTheFirstFrameAsItIsToTheBit) {
    const Settings photons = {{"emit.photons", "32x32"}};
    Film filtered(sceneFromText(kWavyWater), 96, 72, reprojected(photons));
    filtered.renderer().executor().poisonTransients(true);
    filtered.next();
    Film alone(sceneFromText(kWavyWater), 96, 72, photons);
    alone.next();
    EXPECT_EQ(filtered.irradiance(), alone.irradiance());
}

// Nothing moves, so that no mean over frames may differ from one of them: not after many either,
// although each looks up what the one before has looked up. The pattern's noise, which stands still
// here, shows where texels are mixed.
TEST(Temporal, OfAStillSceneIsEachFrame) {
    const Settings photons = reprojected({{"emit.photons", "64x64"}});
    for (const glm::dvec3& offset : {glm::dvec3(0.0), glm::dvec3(1e5, 0.0, -3e4)}) {
        for (const Settings& settings : {photons, pattern("0.2")}) {
            Film film(movedBy(offset), 320, 240, settings, offset);
            moveCamera(film.scene(), 0);
            for (int frame = 0; frame < 12; ++frame)
                film.next({kUnfiltered});
            const std::vector<float> unfiltered = film.saved(kUnfiltered);
            EXPECT_GT(*std::max_element(unfiltered.begin(), unfiltered.end()), 500.0f);
            // A mean of equal numbers is exact but for its own rounding.
            EXPECT_LT(largestDifference(film.irradiance(), unfiltered, 1.0), 1e-6) << offset.x;
        }
    }
}

TEST(Temporal, IsTheMeanOfTheFirstFramesAndThenGivesTheNewestItsWeight) {
    Film film(movedBy(glm::dvec3(0.0)), 80, 60, pattern("0.125"));
    std::vector<double> sum;
    std::vector<float> before;
    for (std::uint64_t frame = 1; frame <= 12; ++frame) {
        film.nextOfSeed(100 + frame, {kUnfiltered});
        const std::vector<float> now = film.saved(kUnfiltered);
        sum.resize(now.size(), 0.0);
        std::vector<float> expected(now.size());
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double value = static_cast<double>(now[i]);
            sum[i] += value;
            expected[i] = static_cast<float>(frame <= 8 ? sum[i] / static_cast<double>(frame)
                                                        : 0.875 * static_cast<double>(before[i]) +
                                                              0.125 * value);
        }
        const std::vector<float> found = film.irradiance();
        // A few roundings a frame.
        EXPECT_LT(largestDifference(found, expected, 1.0), 1e-5) << frame;
        before = found;
    }
}

// The variance of a mean of n frames is 1/n of one frame's. In the long run, with the weight w of
// the newest frame, it is w/(2 - w) of it.
TEST(Temporal, TakesVarianceFromNoiseAsItsWeightSays) {
    const double evenDeviation = 1000.0 / std::sqrt(12.0);
    Film film(movedBy(glm::dvec3(0.0)), 160, 120, pattern("0.2"));
    for (int frame = 1; frame <= 30; ++frame) {
        film.nextOfSeed(static_cast<std::uint64_t>(200 + frame));
        if (frame != 1 && frame != 4 && frame != 30) continue;
        const double expected = frame < 30 ? 1.0 / frame : 0.2 / 1.8;
        const double ratio = std::pow(deviation(film.irradiance(), 2, 500.0) / evenDeviation, 2.0);
        // Some 10,000 pixels tell a variance to 1.4 % at most: a normal variable's.
        EXPECT_NEAR(ratio / expected, 1.0, 0.07) << frame;
    }
}

TEST(Temporal, OfWeightOneIsNoFilter) {
    Film film(movedBy(glm::dvec3(0.0)), 48, 36, pattern("1"));
    film.nextOfSeed(1);
    film.nextOfSeed(2);
    Film alone(movedBy(glm::dvec3(0.0)), 48, 36, {{"gather", "pattern"}});
    alone.nextOfSeed(2);
    EXPECT_EQ(film.irradiance(), alone.irradiance());
    EXPECT_TRUE(std::any_of(film.renderer().compiled().records.begin(),
                            film.renderer().compiled().records.end(), [](const auto& pass) {
                                return pass.name == "temporal.reproject" &&
                                       pass.state == graph::PassState::skipped;
                            }));
}

TEST(Temporal, DisabledLeavesEveryFrameAloneAndForgetsThoseBefore) {
    Film film(movedBy(glm::dvec3(0.0)), 48, 36, pattern("0.1"));
    film.nextOfSeed(1);
    film.settings().disabledPasses = {"temporal.reproject"};
    film.nextOfSeed(2);
    Film alone(movedBy(glm::dvec3(0.0)), 48, 36, {{"gather", "pattern"}});
    alone.nextOfSeed(2);
    EXPECT_EQ(film.irradiance(), alone.irradiance());
    film.settings().disabledPasses = {};
    film.nextOfSeed(3);
    alone.nextOfSeed(3);
    EXPECT_EQ(film.irradiance(), alone.irradiance());
}

TEST(Temporal, ForgetsWhatIsNoLongerSeen) {
    Film film(movedBy(glm::dvec3(0.0)), 80, 60, pattern("0.1"));
    const scene::Camera camera = film.scene().camera;
    film.nextOfSeed(1);
    film.scene().camera.target = camera.position + (camera.position - camera.target);
    film.nextOfSeed(2);
    film.scene().camera = camera;
    film.nextOfSeed(3, {kUnfiltered});
    EXPECT_EQ(film.irradiance(), film.saved(kUnfiltered));
}

TEST(Temporal, KeepsWhatIsNoNumberToItsFrame) {
    Film film(movedBy(glm::dvec3(0.0)), 80, 60, pattern("0.2"));
    film.nextOfSeed(kSeedOfNaN);
    EXPECT_GT(countNotFinite(film.irradiance()), 0u);
    for (const std::uint64_t seed : {20, 21}) {
        moveCamera(film.scene(), 0);
        film.nextOfSeed(seed);
        EXPECT_EQ(countNotFinite(film.irradiance()), 0u) << seed;
    }
}

TEST(Temporal, FiltersWhatGlossyReceiversSendToTheEyeToo) {
    Film film(scene::loadScene("glossy-table"), 80, 60, pattern("0.25"));
    std::vector<double> sum;
    for (std::uint64_t frame = 1; frame <= 3; ++frame) {
        film.nextOfSeed(400 + frame, {kUnfiltered});
        const std::vector<float> now = film.saved(kUnfiltered);
        sum.resize(now.size(), 0.0);
        for (std::size_t i = 0; i < now.size(); ++i)
            sum[i] += static_cast<double>(now[i]);
    }
    // The pattern sends twice its irradiance.
    std::vector<float> expected;
    for (const double value : sum)
        expected.push_back(static_cast<float>(2.0 * value / 3.0));
    const graph::ResourceRef& radiance = film.renderer().outputs().caustic.radiance;
    ASSERT_TRUE(radiance.valid());
    EXPECT_LT(largestDifference(film.renderer().texture(radiance).read(), expected, 1.0), 1e-5);
}

// Waves move, and the mean over frames lags behind: it is between now and before.
TEST(Temporal, OfMovingWaterChangesLessFromFrameToFrame) {
    const auto changeOf = [](const Settings& settings) {
        Film film(sceneFromText(kWavyWater), 96, 72, settings);
        std::vector<float> before;
        for (int frame = 0; frame < 8; ++frame) {
            scene::setTime(film.scene(), 0.05 * frame);
            if (frame == 7) before = film.irradiance();
            film.next();
        }
        return rootMeanSquareDifference(film.irradiance(), before);
    };
    const Settings photons = {{"emit.photons", "32x32"}};
    const double alone = changeOf(photons);
    EXPECT_GT(alone, 1.0);
    EXPECT_LT(changeOf(reprojected(photons)), 0.7 * alone);
}

}  // namespace
}  // namespace kaustik::test
