// SPDX-License-Identifier: MIT
// Scenes that lack something: each renders to a defined result (HARD_CASES.md, E).
#include <algorithm>
#include <cmath>

#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

const std::string kLight = R"(
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
)";
const std::string kFloor = R"(
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [4, 4]
)";
const std::string kWater = R"(
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "water"
shape = "plane"
material = "water"
size = [2, 2]
position = [0, 0.5, 0]
)";

scene::Scene sceneWith(const std::string& parts) {
    return sceneFromText(
        "name = \"bare\"\nbackground_radiance = 2\n[camera]\nposition = [0, 2, 3]\n" + parts);
}

double sum(const Texels& texels) {
    double total = 0.0;
    for (const float value : texels.values)
        total += static_cast<double>(value);
    return total;
}

void expectNoCaustic(const scene::Scene& scene) {
    const Frame frame(scene, 64, 48, {{"emit.photons", "16x16"}}, {"view.radiance"});
    EXPECT_EQ(sum(frame.causticIrradiance()), 0.0);
    EXPECT_EQ(frame.renderer().ledger().watts[transport::kAccountDeposited], 0.0);
}

bool hasPass(const Frame& frame, const std::string& name, graph::PassState state) {
    const auto& records = frame.renderer().compiled().records;
    return std::any_of(records.begin(), records.end(), [&](const graph::PassRecord& record) {
        return record.name == name && record.state == state;
    });
}

TEST(BareScenes, AnEmptySceneShowsTheBackground) {
    const Frame frame(sceneWith(""), 64, 48);
    EXPECT_EQ(sum(frame.causticIrradiance()), 0.0);
    const Texels radiance = frame.read("compose.receiver_radiance");
    EXPECT_EQ(radiance.at(10, 10, 1), 2.0f);
}

TEST(BareScenes, NothingThatFollowsPhotonsRunsWithoutLightSpecularSurfaceOrReceiver) {
    for (const std::string& parts : {kFloor + kWater, kLight + kFloor, kLight + kWater}) {
        const Frame frame(sceneWith(parts), 64, 48);
        EXPECT_EQ(sum(frame.causticIrradiance()), 0.0);
        EXPECT_TRUE(hasPass(frame, "trace.lines", graph::PassState::leftOut));
        EXPECT_TRUE(hasPass(frame, "layers.peel", graph::PassState::leftOut));
        EXPECT_TRUE(hasPass(frame, "compose.display", graph::PassState::ran));
    }
}

TEST(BareScenes, OnePhotonOnePixelAndOneLayerWork) {
    const scene::Scene scene = sceneWith(kLight + kFloor + kWater);
    const Frame onePhoton(scene, 64, 48, {{"emit.photons", "1x1"}});
    EXPECT_GT(sum(onePhoton.causticIrradiance()), 0.0);
    EXPECT_LT(std::abs(onePhoton.renderer().ledger().balance()), 1e-4);
    const Frame onePixel(scene, 1, 1, {{"emit.photons", "16x16"}});
    EXPECT_TRUE(std::isfinite(sum(onePixel.causticIrradiance())));
    const Frame oneLayer(scene, 64, 48, {{"emit.photons", "16x16"}, {"layers.count", "1"}});
    EXPECT_TRUE(std::isfinite(sum(oneLayer.causticIrradiance())));
    EXPECT_LT(std::abs(oneLayer.renderer().ledger().balance()), 1e-4);
}

TEST(BareScenes, ALightThatMeetsNothingSpecularLeavesAnEmptyMap) {
    // The floor is above the water: the first surface that the light meets is never specular.
    expectNoCaustic(sceneWith(kLight + kFloor + R"(
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "water"
shape = "plane"
material = "water"
size = [2, 2]
position = [0, -0.5, 0]
)"));
}

}  // namespace
}  // namespace kaustik::test
