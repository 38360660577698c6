// SPDX-License-Identifier: MIT
// temporal.reproject: what stands still stays as it is, noise is averaged as the weight says, and a
// camera that moves takes the mean along without carrying it over outlines.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "framework/scene/files/scene_file.h"
#include "framework/scene/shapes/height_field.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

constexpr std::uint64_t kSeedOfNaN = 13;

// With gather.pattern, whose irradiance has a closed form (gather_pattern.frag) and needs no
// photon.
Registry registryWithPattern(const glm::dvec3& origin) {
    Registry registry = registerAll();
    registry.node<GatherStage>(
        "pattern", {"A closed form.", "a test"},
        std::function([origin](FrameBuilder& frame, const params::NoParams&, CausticMap map,
                               Surfaces surfaces) {
            return frame.pass<IrradianceMap>(
                "gather.pattern", "a test",
                [&](graph::PassSetup& setup, IrradianceMap& data) {
                    setup.sample("receiver", surfaces.eye.receiver);
                    setup.sample("receiverSurface", surfaces.eye.receiverSurface);
                    data.ledger = map.ledger;
                    data.irradiance = setup.create<IrradianceTexel>("caustic.irradiance",
                                                                    frame.width(), frame.height());
                    if (!frame.needs().glossyReceivers) return;
                    data.radiance = setup.create<RadianceTexel>("caustic.radiance", frame.width(),
                                                                frame.height());
                },
                [origin, &frameInputs = frame.inputs()](const IrradianceMap& data,
                                                        gl::PassContext& context) {
                    const scene::Camera& camera = frameInputs.gpuScene.scene().camera;
                    gl::Command command =
                        context.fullscreen("tests/gpu/shaders/gather_pattern.frag");
                    command.set("eyeFromOrigin", glm::vec3(camera.position - origin))
                        .set("seed", static_cast<unsigned>(frameInputs.seed))
                        .set("seedOfNaN", static_cast<unsigned>(kSeedOfNaN))
                        .target(data.irradiance);
                    if (data.radiance.valid()) command.define("HAS_RADIANCE").target(data.radiance);
                    command.draw();
                });
        }));
    return registry;
}

// Frames of a scene that the test moves, one after the other, of one renderer.
class Film {
  public:
    Film(scene::Scene scene, int width, int height, const Settings& settings,
         const glm::dvec3& origin = {})
        : scene_(std::move(scene)), registry_(registryWithPattern(origin)) {
        settings_.technique = registry_.findTechnique("screen_space_photons");
        settings_.params = registry_.makeParams(settings_.technique);
        settings_.width = width;
        settings_.height = height;
        for (const auto& [name, value] : settings)
            settings_.params.set(name, value, "a test");
        renderer_.emplace(context(), registry_, scene_, settings_);
    }

    scene::Scene& scene() { return scene_; }
    RenderSettings& settings() { return settings_; }
    Renderer& renderer() { return *renderer_; }

    // Renders the scene as it is now; `saved` can be read afterwards.
    void next(const std::vector<std::string>& saved = {}) {
        renderer_->update(settings_);
        renderer_->build(Purpose::picture, saved);
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer_->renderFrame(timer);
    }
    // With noise of its own.
    void nextOfSeed(std::uint64_t seed, const std::vector<std::string>& saved = {}) {
        settings_.seed = seed;
        next(saved);
    }

    // Four values a pixel, of the frame that was rendered last.
    [[nodiscard]] std::vector<float> irradiance() const {
        return renderer_->texture(renderer_->outputs().caustic.irradiance).read();
    }
    [[nodiscard]] std::vector<float> saved(const std::string& name) const {
        return renderer_->texture(renderer_->graph().find(name)).read();
    }

  private:
    scene::Scene scene_;
    Registry registry_;
    RenderSettings settings_;
    std::optional<Renderer> renderer_;
};

Settings reprojected(Settings more = {}) {
    more.emplace_back("temporal", "reproject");
    return more;
}

Settings pattern(const std::string& weight = "0.2") {
    return reprojected({{"gather", "pattern"}, {"temporal.reproject.weight", weight}});
}

constexpr const char* kUnfiltered = "temporal.unfiltered";

// The largest difference of two images, relative to the second where that is above `floor`.
double largestDifference(const std::vector<float>& image, const std::vector<float>& expected,
                         double floor) {
    double largest = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double value = static_cast<double>(expected[i]);
        const double difference = std::abs(static_cast<double>(image[i]) - value);
        // A difference that is no number is the largest of all.
        if (!(difference <= std::numeric_limits<double>::max())) return difference;
        largest = std::max(largest, difference / std::max(std::abs(value), floor));
    }
    return largest;
}

std::size_t countNotFinite(const std::vector<float>& values) {
    return static_cast<std::size_t>(std::count_if(
        values.begin(), values.end(), [](float value) { return !std::isfinite(value); }));
}

// Root of the mean square of channel `channel` less `mean`, over pixels that are lit.
double deviation(const std::vector<float>& image, std::size_t channel, double mean) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.size(); i += 4) {
        if (image[i] == 0.0f) continue;
        sum += std::pow(static_cast<double>(image[i + channel]) - mean, 2.0);
        ++count;
    }
    return std::sqrt(sum / static_cast<double>(count));
}

double rootMeanSquareDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2.0);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

// By about four pixels of 320 sideways, with as much of a turn, a roll and some way forward.
void moveCamera(scene::Scene& scene, int frame) {
    scene::Camera& camera = scene.camera;
    const double side = frame % 2 == 0 ? 1.0 : 0.7;
    camera.position += side * glm::dvec3(0.041, 0.013, -0.029);
    camera.target += side * glm::dvec3(-0.017, 0.005, 0.013);
    camera.up += glm::dvec3(0.004, 0.0, 0.002);
}

// Everything by `offset`, m.
scene::Scene movedBy(const glm::dvec3& offset) {
    return sceneFromText(fmt::format(R"(
name = "steps"
[camera]
position = [{}, {}, {}]
target = [{}, {}, {}]
[[light]]
name = "sun"
type = "directional"
direction = [0.1, -1, 0]
irradiance = 1000
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "brick"
type = "lambertian"
albedo = 0.4
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "floor"
shape = "plane"
material = "chalk"
size = [4, 4]
position = [{}, {}, {}]
[[object]]
name = "block"
shape = "box"
material = "brick"
size = [0.5, 0.6, 0.4]
position = [{}, {}, {}]
[[object]]
name = "water"
shape = "plane"
material = "water"
size = [1, 1]
position = [{}, {}, {}]
)",
                                     offset.x + 0.3, offset.y + 2.0, offset.z + 1.9, offset.x,
                                     offset.y - 0.4, offset.z, offset.x, offset.y - 0.5, offset.z,
                                     offset.x, offset.y - 0.2, offset.z, offset.x, offset.y + 0.4,
                                     offset.z));
}

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

// What frames come to without looking anything up: what the tests below must be able to find.
void addGhosts(std::vector<float>& ghosts, const std::vector<float>& now) {
    if (ghosts.empty()) ghosts = now;
    for (std::size_t i = 0; i < now.size(); ++i)
        ghosts[i] += 0.2f * (now[i] - ghosts[i]);
}

// Calls visit(index, neighbour's index) for all pixels so near as `reach`, itself among them; the
// screen's border leaves none out.
template <class Visit>
void forNeighbours(int width, int height, int reach, const Visit& visit) {
    const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v) {
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u)
                    visit(index(x, y), index(u, v));
            }
        }
    }
}

// A moving camera takes the mean along. Each material's irradiance is its own number, which a mean
// over the same surface keeps and one over two surfaces does not: at outlines, at edges and where
// something comes out from behind something else.
void expectNoGhosts(const glm::dvec3& offset) {
    constexpr int kWidth = 320;
    constexpr int kHeight = 240;
    Film film(movedBy(offset), kWidth, kHeight, pattern("0.2"), offset);
    std::vector<float> ghosts;
    for (int frame = 0; frame < 12; ++frame) {
        moveCamera(film.scene(), frame);
        film.nextOfSeed(static_cast<std::uint64_t>(300 + frame),
                        {kUnfiltered, "eye.receiver_surface"});
        addGhosts(ghosts, film.saved(kUnfiltered));
    }
    const std::vector<float> now = film.saved(kUnfiltered);
    const std::vector<float> found = film.irradiance();
    EXPECT_EQ(countNotFinite(found), 0u);

    // Pixels that see one face of one thing as far as its history may come from, and the rest.
    const std::vector<float> surface = film.saved("eye.receiver_surface");
    std::vector<int> alike(now.size() / 4, 0);
    constexpr int kReach = 4;
    forNeighbours(kWidth, kHeight, kReach, [&](std::size_t pixel, std::size_t other) {
        const float* one = surface.data() + 4 * pixel;
        const float* two = surface.data() + 4 * other;
        const float cosine = one[0] * two[0] + one[1] * two[1] + one[2] * two[2];
        if (one[3] > 0.0f && one[3] == two[3] && cosine > 0.99f) ++alike[pixel];
    });
    const int all = (2 * kReach + 1) * (2 * kReach + 1);
    EXPECT_GT(std::count(alike.begin(), alike.end(), all), kWidth * kHeight / 4);
    const auto largestOf = [&](const std::vector<float>& image, std::size_t channel,
                               bool isInside) {
        double largest = 0.0;
        for (std::size_t pixel = 0; pixel < alike.size(); ++pixel) {
            if ((alike[pixel] == all) != isInside) continue;
            const std::size_t i = 4 * pixel + channel;
            largest = std::max(
                largest, std::abs(static_cast<double>(image[i]) - static_cast<double>(now[i])));
        }
        return largest;
    };
    for (const bool isInside : {true, false})
        EXPECT_LT(largestOf(found, 0, isInside), 1e-3) << isInside;
    EXPECT_GT(largestOf(ghosts, 0, false), 50.0);
    // A pixel sees up to 3 cm of the floor, where linear interpolation errs by (3/m 0.03 m)²/8 of
    // 1000 W/m² along either axis at most, 2 W/m²; four times that is left of all frames before,
    // (1 - w)/w of what each adds.
    EXPECT_LT(largestOf(found, 1, true), 8.0);
    EXPECT_GT(largestOf(ghosts, 1, true), 80.0);
    // At outlines the texels that are left lie next to the place: by less than a pixel, over which
    // the waves rise by 3/m 0.03 m of 1000 W/m².
    EXPECT_LT(largestOf(found, 1, false), 90.0);
    // And it is a mean: variance falls as if the camera stood, and more where texels are mixed. A
    // part of the pixels is new.
    EXPECT_LT(deviation(found, 2, 500.0), 0.4 * deviation(now, 2, 500.0));
    EXPECT_GT(deviation(found, 2, 500.0), 0.0);
}

TEST(Temporal, OfAMovingCameraCarriesNothingOverOutlines) {
    expectNoGhosts(glm::dvec3(0.0));
}

TEST(Temporal, OfAMovingCameraIsTheSameFarFromTheOrigin) {
    expectNoGhosts(glm::dvec3(1e5, 0.0, -3e4));
}

// Real light with a real silhouette: a rod in the light that a ball has focused, and the camera
// going round. The caustic stands still, so that all that the filter may add is blur: nothing is
// brighter or darker than what each frame has two pixels around.
TEST(Temporal, OfAMovingCameraOverACausticStaysNearEachFrame) {
    constexpr int kWidth = 320;
    constexpr int kHeight = 240;
    Film film(scene::loadScene("blocker"), kWidth, kHeight,
              reprojected({{"emit.photons", "192x192"}}));
    std::vector<float> ghosts;
    for (int frame = 0; frame < 6; ++frame) {
        moveCamera(film.scene(), frame);
        film.next({kUnfiltered});
        addGhosts(ghosts, film.saved(kUnfiltered));
    }
    const std::vector<float> now = film.saved(kUnfiltered);
    const std::vector<float> found = film.irradiance();
    EXPECT_EQ(countNotFinite(found), 0u);
    EXPECT_GT(*std::max_element(now.begin(), now.end()), 2000.0f);
    std::vector<float> lowest(now.size() / 4, std::numeric_limits<float>::max());
    std::vector<float> highest(now.size() / 4, 0.0f);
    forNeighbours(kWidth, kHeight, 2, [&](std::size_t pixel, std::size_t other) {
        lowest[pixel] = std::min(lowest[pixel], now[4 * other]);
        highest[pixel] = std::max(highest[pixel], now[4 * other]);
    });
    const auto farthestOutside = [&](const std::vector<float>& image) {
        float farthest = 0.0f;
        for (std::size_t pixel = 0; pixel < lowest.size(); ++pixel) {
            farthest = std::max(
                {farthest, lowest[pixel] - image[4 * pixel], image[4 * pixel] - highest[pixel]});
        }
        return farthest;
    };
    // W/m²: frames differ a little by where their pixels lie.
    EXPECT_LT(farthestOutside(found), 20.0f);
    EXPECT_GT(farthestOutside(ghosts), 500.0f);
    EXPECT_LT(rootMeanSquareDifference(found, now), 0.5 * rootMeanSquareDifference(ghosts, now));
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
