// SPDX-License-Identifier: MIT
// Estimator 1: absolute irradiance against closed forms, the ledger, and that a result depends on
// nothing but its settings.
#include "framework/reference/light_tracing.h"

#include <cmath>
#include <numbers>

#include "framework/core/error.h"
#include "framework/reference/eye.h"
#include "framework/scene/files/scene_file.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

// In standard errors, what the largest of `count` normal deviations exceeds once in 1e5 runs.
double largestDeviations(std::size_t count) {
    return std::sqrt(2.0 * std::log(static_cast<double>(count) * 1e5));
}

PixelSums trace(const EmbreeScene& scene, const LightTraceSettings& settings, std::uint64_t batches,
                int threads = 0) {
    PixelSums sums = makeLightTraceSums(scene, settings);
    RunOptions options;
    options.stop.batches = batches;
    options.threads = threads;
    lightTrace(scene, settings, options, sums);
    return sums;
}

TEST(LightTracing, StillWaterGivesTheFloorItsClosedFormIrradiance) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 64;
    settings.height = 48;
    settings.photonsPerBatch = 1u << 16;
    const PixelSums sums = trace(embree, settings, 64);
    const double expected = 1000.0 * (1.0 - std::pow(0.333 / 2.333, 2));  // 979.626
    const Eye eye(embree, settings.width, settings.height);
    std::size_t tested = 0;
    double mean = 0.0;
    double variance = 0.0;
    for (int row = 0; row < settings.height; ++row) {
        for (int column = 0; column < settings.width; ++column) {
            // Whole pixels on the floor: it ends at |x| = 2 and |z| = 1.5, y = -1.2.
            bool isFloor = true;
            for (const double corner : {0.0, 1.0, 2.0, 3.0}) {
                const glm::dvec3 ray =
                    eye.ray(column + std::fmod(corner, 2.0), row + std::floor(corner / 2.0));
                const glm::dvec3 origin = eye.position() + embree.center();
                const glm::dvec3 floor = origin + ray * ((-1.2 - origin.y) / ray.y);
                isFloor = isFloor && std::abs(floor.x) < 1.999 && std::abs(floor.z) < 1.499;
            }
            if (!isFloor) continue;
            const auto value = static_cast<std::size_t>(3 * (row * settings.width + column) + 1);
            const double error = sums.standardError(value);
            // 64 batches: the error itself is known to 9 %, so the tail is a little wider.
            EXPECT_LT(std::abs(sums.mean(value) - expected), 1.3 * largestDeviations(3000) * error);
            mean += sums.mean(value);
            variance += error * error;
            ++tested;
        }
    }
    ASSERT_GT(tested, 1000u);
    const auto count = static_cast<double>(tested);
    EXPECT_NEAR(mean / count, expected, 5.0 * std::sqrt(variance) / count);
    // … which is itself below one per mille: the test is worth something.
    EXPECT_LT(5.0 * std::sqrt(variance) / count, 1e-3 * expected);
}

TEST(LightTracing, StillWaterUnderALampGivesTheClosedFormOffAndOnTheAxis) {
    const double height = 1.5;
    const double depth = 0.8;
    const double index = 1.333;
    const double intensity = 40.0;
    scene::Scene scene;
    addObject(scene, scene::makePlane({{9.0, 9.0}, {1, 1}}), glass(index));
    addObject(scene, scene::makePlane({{40.0, 40.0}, {1, 1}}), scene::Material{},
              {0.0, -depth, 0.0});
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.position = {0.0, height, 0.0};
    lamp.power = glm::vec3(static_cast<float>(intensity));
    scene.lights.push_back(lamp);
    scene.camera.position = {0.0, 2.2, 0.0};
    scene.camera.target = {0.0, -depth, 0.0};
    scene.camera.up = {0.0, 0.0, -1.0};
    scene.camera.verticalFovDegrees = 70.0;
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 41;
    settings.height = 41;
    settings.photonsPerBatch = 1u << 17;
    const PixelSums sums = trace(embree, settings, 48);
    const Eye eye(embree, settings.width, settings.height);

    const auto radiusAt = [&](double angle) {
        const double inside = std::asin(std::sin(angle) / index);
        return height * std::tan(angle) + depth * std::tan(inside);
    };
    const auto irradianceAt = [&](double radius) {
        if (radius < 1e-6) {
            const double reflected = (index - 1.0) / (index + 1.0);
            return intensity * (1.0 - reflected * reflected) / std::pow(height + depth / index, 2);
        }
        double low = 0.0;
        double high = 1.5;
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (low + high);
            (radiusAt(middle) < radius ? low : high) = middle;
        }
        const double angle = 0.5 * (low + high);
        const double inside = std::asin(std::sin(angle) / index);
        const double cosI = std::cos(angle);
        const double cosT = std::cos(inside);
        const double s = (cosI - index * cosT) / (cosI + index * cosT);
        const double p = (index * cosI - cosT) / (index * cosI + cosT);
        // dr/dθ1 by hand: cos θ2 dθ2 = cos θ1 dθ1 / n.
        const double slope = height / (cosI * cosI) + depth * cosI / (index * cosT * cosT * cosT);
        return intensity * (1.0 - 0.5 * (s * s + p * p)) * std::sin(angle) / (radius * slope);
    };
    for (int row = 0; row < settings.height; ++row) {
        for (int column = 0; column < settings.width; ++column) {
            // The mean over the pixel by Simpson's rule, good to 1e-5 here.
            double expected = 0.0;
            for (int i = 0; i < 9; ++i) {
                const double weight = (i % 3 == 1 ? 4.0 : 1.0) * (i / 3 == 1 ? 4.0 : 1.0) / 36.0;
                const glm::dvec3 ray = eye.ray(column + 0.5 * (i % 3), row + 0.5 * (i / 3));
                const glm::dvec3 origin = eye.position() + embree.center();
                const glm::dvec3 floor = origin + ray * ((-depth - origin.y) / ray.y);
                expected += weight * irradianceAt(std::hypot(floor.x, floor.z));
            }
            const auto value = static_cast<std::size_t>(3 * (row * settings.width + column));
            EXPECT_LT(std::abs(sums.mean(value) - expected),
                      1.3 * largestDeviations(1681) * sums.standardError(value) + 1e-5 * expected)
                << row << ", " << column;
        }
    }
    const auto middle = static_cast<std::size_t>(3 * (20 * 41 + 20));
    EXPECT_LT(sums.standardError(middle), 0.02 * sums.mean(middle));
}

TEST(LightTracing, EveryWattIsAccountedFor) {
    for (const char* name : {"glass-sphere", "pool", "ring", "cornell-bunny"}) {
        const scene::Scene scene = scene::loadScene(name);
        const EmbreeScene embree(scene);
        LightTraceSettings settings;
        settings.width = 32;
        settings.height = 24;
        settings.photonsPerBatch = 20000;
        const Energy all = trace(embree, settings, 4).energy();
        // The ledger's unit is 2^-54 of the flux, an account a sum of 1e5 roundings of 1e-16.
        EXPECT_LT(std::abs(all.balance()), 1e-10) << name;
        EXPECT_GT(all.watts[transport::kAccountDeposited], 0.0) << name;
        settings.filter.transmissionOnly = true;
        settings.filter.maximumInteractions = 2;
        const Energy some = trace(embree, settings, 4).energy();
        EXPECT_LT(std::abs(some.balance()), 1e-10) << name;
        // The same photons hit the same first surfaces.
        EXPECT_NEAR(some.watts[transport::kAccountEmitted], all.watts[transport::kAccountEmitted],
                    1e-12 * all.watts[transport::kAccountEmitted])
            << name;
    }
}

// Of water in the sun: R is Fresnel's reflectance, all of it goes to the sky.
TEST(LightTracing, OfTheReflectedBranchIsWhatFresnelReflects) {
    scene::Scene scene;
    addObject(scene, scene::makePlane({{2.0, 3.0}, {1, 1}}), glass(1.333));
    scene::Light sun;
    sun.direction = {0.0, -1.0, 0.0};
    sun.power = glm::vec3(1000.0f);
    scene.lights.push_back(sun);
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = settings.height = 1;
    settings.photonsPerBatch = 1000;
    const double reflectance = std::pow(0.333 / 2.333, 2.0);
    const auto shareOf = [&](bool isReflected, unsigned account) {
        settings.filter.transmissionOnly = !isReflected;
        settings.filter.reflectionOnly = isReflected;
        const Energy energy = trace(embree, settings, 2).energy();
        EXPECT_LT(std::abs(energy.balance()), 1e-10);
        return energy.watts[account] / energy.watts[transport::kAccountEmitted];
    };
    EXPECT_NEAR(shareOf(true, transport::kAccountLeftScene), reflectance, 1e-6);
    EXPECT_NEAR(shareOf(true, transport::kAccountUntracedBranch), 1.0 - reflectance, 1e-6);
    EXPECT_NEAR(shareOf(false, transport::kAccountUntracedBranch), reflectance, 1e-6);
}

// Light without a place has no path behind it to be absorbed on; the device's photons have none
// either.
TEST(LightTracing, ASunThatFirstHitsDarkWaterFromWithinIsAsStrongAsTheSceneSays) {
    scene::Scene scene;
    addObject(scene, scene::makePlane({{2.0, 3.0}, {1, 1}}), glass(1.333));
    scene.materials[0].absorptionPerMeter = glm::vec3(2.0f);
    scene::Light sun;
    sun.direction = {0.0, 1.0, 0.0};
    sun.power = glm::vec3(1000.0f);
    scene.lights.push_back(sun);
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = settings.height = 1;
    settings.photonsPerBatch = 1000;
    // 6 m², three channels; the rectangle that is sampled is the plane and a margin of 1e-6.
    EXPECT_NEAR(trace(embree, settings, 2).energy().watts[transport::kAccountEmitted] / 6000.0, 1.0,
                1e-5);
}

TEST(LightTracing, ResultIsTheSameBitsAtOneTwoAndEightThreads) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 60;
    settings.height = 40;
    settings.photonsPerBatch = 5000;
    const PixelSums one = trace(embree, settings, 12, 1);
    EXPECT_EQ(one, trace(embree, settings, 12, 2));
    EXPECT_EQ(one, trace(embree, settings, 12, 8));
    settings.seed = 2;
    EXPECT_NE(one, trace(embree, settings, 12, 1));
}

TEST(LightTracing, ShardsMergeExactlyInAnyOrderAndOnlyOnce) {
    const scene::Scene scene = scene::loadScene("ring");
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 60;
    settings.height = 40;
    settings.photonsPerBatch = 5000;
    const PixelSums whole = trace(embree, settings, 9);
    std::vector<PixelSums> shards;
    for (const BatchRange range : {BatchRange{5, 9}, BatchRange{0, 2}, BatchRange{2, 5}}) {
        shards.push_back(makeLightTraceSums(embree, settings));
        RunOptions options;
        options.shard = range;
        lightTrace(embree, settings, options, shards.back());
    }
    PixelSums merged = makeLightTraceSums(embree, settings);
    for (const PixelSums& shard : shards)
        merged.merge(shard);
    EXPECT_EQ(whole, merged);
    EXPECT_THROW(merged.merge(shards[1]), ConfigError);
    settings.width = 61;
    EXPECT_THROW(merged.merge(makeLightTraceSums(embree, settings)), ConfigError);
}

TEST(LightTracing, InterruptedAndResumedIsTheSameBitsAsUninterrupted) {
    const scene::Scene scene = scene::loadScene("ring");
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 60;
    settings.height = 40;
    settings.photonsPerBatch = 5000;
    const PixelSums whole = trace(embree, settings, 10);
    PixelSums sums = makeLightTraceSums(embree, settings);
    RunOptions options;
    options.stop.batches = 10;
    options.progress = [](const Progress& progress) { return progress.batches < 4; };
    lightTrace(embree, settings, options, sums);
    EXPECT_EQ(sums.batchCount(), 4u);
    PixelSums resumed = PixelSums::fromBytes(sums.toBytes("key"), "key", "memory");
    EXPECT_EQ(resumed, sums);
    options.progress = nullptr;
    lightTrace(embree, settings, options, resumed);
    EXPECT_EQ(resumed, whole);
}

TEST(LightTracing, StopsAtTheErrorThatWasAskedFor) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 40;
    settings.height = 30;
    settings.photonsPerBatch = 20000;
    PixelSums sums = makeLightTraceSums(embree, settings);
    RunOptions options;
    options.stop.relativeError = 0.02;
    options.stop.batches = 400;
    lightTrace(embree, settings, options, sums);
    EXPECT_LE(sums.relativeStandardError(kIrradianceLayer), 0.02);
    EXPECT_LT(sums.batchCount(), 400u);
    EXPECT_THROW(lightTrace(embree, settings, RunOptions{}, sums), ConfigError);
}

TEST(LightTracing, ScenesWithNothingToSeeGiveNothing) {
    scene::Scene scene;
    const EmbreeScene empty(scene);
    LightTraceSettings settings;
    settings.width = settings.height = 1;
    EXPECT_EQ(trace(empty, settings, 2).mean(0), 0.0);
    scene::Scene dark = scene::loadScene("glass-sphere");
    dark.lights.clear();
    const EmbreeScene unlit(dark);
    const PixelSums sums = trace(unlit, settings, 2);
    EXPECT_EQ(sums.mean(0), 0.0);
    EXPECT_EQ(sums.energy().balance(), 0.0);
}

TEST(LightTracing, SceneFarFromTheOriginGivesTheSamePicture) {
    scene::Scene scene = scene::loadScene("flat-water");
    LightTraceSettings settings;
    settings.width = 40;
    settings.height = 30;
    settings.photonsPerBatch = 20000;
    const EmbreeScene here(scene);
    const PixelSums near = trace(here, settings, 4);
    const glm::dvec3 shift(1e5, -2e5, 3e5);
    for (scene::Object& object : scene.objects)
        object.toWorld[3] += glm::dvec4(shift, 0.0);
    scene.camera.position += shift;
    scene.camera.target += shift;
    const EmbreeScene there(scene);
    const PixelSums far = trace(there, settings, 4);
    // The same photons up to the rounding of the shift, 3e-11 m: a photon at the edge of a pixel
    // may change over, and nothing else.
    double difference = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < std::size_t{40} * 30 * 3; ++i) {
        difference += std::abs(near.mean(i) - far.mean(i));
        total += near.mean(i);
    }
    EXPECT_LT(difference, 1e-4 * total);
}

}  // namespace
}  // namespace kaustik::reference
