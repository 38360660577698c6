// SPDX-License-Identifier: MIT
// Photons are followed over as many specular surfaces as is asked for, where they can hit them
// again, and over no more than they can hit.
#include <algorithm>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using transport::kAccountBounceLimit;

// A low sun on steep waves: what one crest reflects hits the next one.
scene::Scene choppyWater() {
    return sceneFromText(R"(
name = "choppy"
[camera]
position = [0, 2.5, 3]
target = [0.3, 0, 0]
[[light]]
name = "sun"
type = "directional"
direction = [0.9, -0.5, 0]
irradiance = 1000
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "floor"
shape = "plane"
material = "chalk"
size = [8, 8]
position = [0, -0.5, 0]
[[object]]
name = "water"
shape = "water"
material = "water"
size = [2, 2]
cells = [128, 32]
waves = [{amplitude = 0.06, wavelength = 0.5, direction_degrees = 0}]
)");
}

int timesRun(const Frame& frame, const std::string& pass) {
    const auto& steps = frame.renderer().compiled().steps;
    return static_cast<int>(std::count_if(steps.begin(), steps.end(),
                                          [&](const auto& step) { return step.name == pass; }));
}

TEST(Bounces, AreFollowedAsFarAsIsAskedOverWavesThatLightComesBackTo) {
    const scene::Scene scene = choppyWater();
    double onTheirWay = 1e30;
    std::vector<float> before;
    for (const char* bounces : {"1", "2", "4"}) {
        const Frame frame(
            scene, 160, 120,
            {{"specular", "split"}, {"specular.bounces", bounces}, {"emit.photons", "96x96"}});
        const double watts = frame.renderer().ledger().watts[kAccountBounceLimit];
        EXPECT_LT(watts, onTheirWay) << bounces;
        onTheirWay = watts;
        const Texels irradiance = frame.causticIrradiance();
        EXPECT_NE(irradiance.values, before) << bounces;
        before = irradiance.values;
    }
}

TEST(Bounces, AreNoneMoreThanOneWhereLightHitsWaterOnce) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Frame frame(scene, 160, 120, {{"specular.bounces", "8"}, {"emit.photons", "32x32"}});
    EXPECT_EQ(timesRun(frame, "trace.hierarchical"), 1);
    EXPECT_EQ(frame.renderer().ledger().watts[kAccountBounceLimit], 0.0);
}

// Irradiance summed over the pixels that see a material.
double lightOn(const Frame& frame, std::uint32_t material) {
    const Texels irradiance = frame.causticIrradiance();
    const Texels surface = frame.read("eye.receiver_surface");
    double sum = 0.0;
    for (int y = 0; y < surface.height; ++y) {
        for (int x = 0; x < surface.width; ++x) {
            if (static_cast<std::uint32_t>(surface.at(x, y, 3)) == material)
                sum += irradiance.rgb(x, y).g;
        }
    }
    return sum;
}

TEST(Branches, AreBothFollowedByDefaultWhereOnlyReflectedLightReachesAWall) {
    const scene::Scene scene = scene::loadScene("pool-reflections");
    ASSERT_EQ(scene.materials[2].name, "stucco");
    const Settings photons = {{"emit.photons", "48x48"}};
    Settings one = photons;
    one.emplace_back("specular", "interface");
    const Frame both(scene, 160, 120, photons);
    EXPECT_GT(timesRun(both, "specular.split"), 0);
    EXPECT_GT(lightOn(both, 3), 0.0);
    const Frame transmitted(scene, 160, 120, one);
    EXPECT_EQ(timesRun(transmitted, "specular.split"), 0);
    EXPECT_EQ(lightOn(transmitted, 3), 0.0);
}

TEST(Branches, AreOneByDefaultWhereTheOtherIsNotSeen) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Frame frame(scene, 160, 120, {{"emit.photons", "16x16"}});
    EXPECT_GT(timesRun(frame, "specular.interface"), 0);
    EXPECT_EQ(timesRun(frame, "specular.split"), 0);
}

// What its outside reflects, and what goes on inside, lights the floor as well.
TEST(Branches, AreBothFollowedByDefaultAtABody) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const Frame frame(scene, 160, 120, {{"emit.photons", "16x16"}});
    EXPECT_GT(timesRun(frame, "specular.split"), 0);
    EXPECT_EQ(timesRun(frame, "specular.interface"), 0);
}

}  // namespace
}  // namespace kaustik::test
