// SPDX-License-Identifier: MIT
// Photons traced on tiles of the screen (K06, section 6) give the picture of the whole one, to the
// bit: the sums of light do not depend on an order, and each step of a ray is asked alike.
#include "framework/run/tile_run.h"

#include <gtest/gtest.h>

#include <tuple>

#include "framework/run/settings.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"
#include "tests/unit/temporary_folder.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

// A scene by its name, the water of wavy_water.h; a tracer; a number of tiles.
class Tiles : public testing::TestWithParam<std::tuple<const char*, const char*, std::uint64_t>> {
  protected:
    struct Finished {
        std::vector<float> irradiance;
        std::vector<float> radiance;
        EnergyLedger ledger;
    };

    [[nodiscard]] static scene::Scene sceneNamed(const std::string& name) {
        return name == "wavy" ? sceneFromText(kWavyWater) : scene::loadScene(name);
    }
    // Two interactions let photons into a ball and out again.
    [[nodiscard]] RenderSettings settings(const std::string& tracer) const {
        RenderSettings settings =
            run::makeSettings({.technique = "screen_space_photons",
                               .assignments = {{"trace", tracer, "test"},
                                               {"emit.photons", "32x32", "test"},
                                               {"specular.bounces", "2", "test"},
                                               {"shadow.map.size", "64", "test"}}},
                              registry_);
        run::setSize(settings, {64, 48});
        return settings;
    }
    [[nodiscard]] Finished render(const scene::Scene& scene, const RenderSettings& settings) const {
        Renderer renderer(context(), registry_, scene, settings);
        renderer.build(Purpose::measurement);
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer.renderFrame(timer);
        return {renderer.texture(renderer.outputs().caustic.irradiance).read(),
                renderer.texture(renderer.outputs().picture.radiance).read(), renderer.ledger()};
    }

    Registry registry_ = registerAll();
    TemporaryFolder folder_;
};

TEST_P(Tiles, GiveTheBitsOfTheWholePicture) {
    const auto& [name, tracer, count] = GetParam();
    const scene::Scene scene = sceneNamed(name);
    RenderSettings settings = this->settings(tracer);
    const Finished whole = render(scene, settings);
    ASSERT_GT(whole.ledger.watts[transport::kAccountDeposited], 0.0) << "there is light to compare";

    const std::filesystem::path folder = folder_ / "tiles";
    std::filesystem::create_directories(folder);
    int rounds = 0;
    for (bool isComplete = false; !isComplete; ++rounds) {
        for (std::uint64_t number = 1; number <= count; ++number)
            ASSERT_TRUE(
                run::traceTile(context(), registry_, scene, settings, folder, {number, count}));
        const std::optional<run::MergedRound> merged = run::mergeTiles(folder);
        ASSERT_TRUE(merged);
        EXPECT_EQ(merged->head.round, rounds + 1);
        isComplete = merged->head.isComplete;
    }
    EXPECT_EQ(rounds, std::string(name) == "wavy" ? 1 : 2);
    EXPECT_FALSE(run::traceTile(context(), registry_, scene, settings, folder, {1, count}))
        << "no photon goes on";
    EXPECT_FALSE(run::mergeTiles(folder)) << "all rounds are merged";

    settings.tiles =
        run::loadTiles(folder, run::tileSubject(context(), scene, this->settings(tracer)));
    Finished tiled = render(scene, settings);
    // Not part of the balance; of hits that tiles have found nobody knows it.
    constexpr unsigned kNormals = transport::kAccountTriangleNormal;
    tiled.ledger.watts[kNormals] = whole.ledger.watts[kNormals];
    tiled.ledger.events[kNormals] = whole.ledger.events[kNormals];
    EXPECT_EQ(tiled.irradiance, whole.irradiance);
    EXPECT_EQ(tiled.radiance, whole.radiance);
    EXPECT_EQ(tiled.ledger.watts, whole.ledger.watts);
    EXPECT_EQ(tiled.ledger.events, whole.ledger.events);
    EXPECT_EQ(tiled.ledger.traced, whole.ledger.traced);
}

std::string nameOf(const testing::TestParamInfo<Tiles::ParamType>& tested) {
    std::string name = std::string(std::get<0>(tested.param)) + "_" + std::get<1>(tested.param);
    std::replace(name.begin(), name.end(), '-', '_');
    return name + "_" + std::to_string(std::get<2>(tested.param));
}

INSTANTIATE_TEST_SUITE_P(Water, Tiles,
                         testing::Combine(testing::Values("wavy"), testing::Values("hierarchical"),
                                          testing::Values(1, 2, 3, 4)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Ball, Tiles,
                         testing::Combine(testing::Values("glass-sphere"),
                                          testing::Values("hierarchical"),
                                          testing::Values(1, 2, 3, 4)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Tracers, Tiles,
                         testing::Combine(testing::Values("glass-sphere"),
                                          testing::Values("hierarchical_compute", "march",
                                                          "march_compute", "lines"),
                                          testing::Values(2)),
                         nameOf);

// Work is counted: of the layers, and of the rays' steps.
TEST(TileOfThePicture, TakesItsShareOfTheWork) {
    Registry registry = registerAll();
    const scene::Scene scene = sceneFromText(kWavyWater);
    RenderSettings settings = run::makeSettings(
        {.technique = "screen_space_photons", .assignments = {{"trace", "march", "test"}}},
        registry);
    run::setSize(settings, {256, 192});
    const auto costOf = [&](const Shard& tile) {
        const TemporaryFolder folder;
        return run::traceTile(context(), registry, scene, settings, folder / ".", tile)->head.cost;
    };
    const run::TileCost whole = costOf({1, 1});
    ASSERT_GT(whole.steps, 0u);
    run::TileCost sum;
    for (std::uint64_t number = 1; number <= 4; ++number) {
        const run::TileCost cost = costOf({number, 4});
        EXPECT_LT(cost.fragments, whole.fragments / 2);
        EXPECT_LE(cost.shownPixels, (128u + 4u) * (96u + 4u)) << "a border of four pixels";
        sum.ownPixels += cost.ownPixels;
        sum.steps += cost.steps;
    }
    EXPECT_EQ(sum.ownPixels, whole.ownPixels);
    // Every step of the whole search is asked by the tile that it lies on, and steps behind a hit
    // that is on another tile are asked in vain.
    EXPECT_GE(sum.steps, whole.steps);
}

}  // namespace
}  // namespace kaustik::test
