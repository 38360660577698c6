// SPDX-License-Identifier: MIT
// Scenes that lack something: what cannot be is not even built. What they render to is for the hard
// cases (framework/numerics).
#include <algorithm>

#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/scene_parts.h"

namespace kaustik::test {
namespace {

const std::string kLight = R"(
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
)";
const std::string kFloor = greyFloor(4.0);
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

bool hasPass(const Frame& frame, const std::string& name, graph::PassState state) {
    const auto& records = frame.renderer().compiled().records;
    return std::any_of(records.begin(), records.end(), [&](const graph::PassRecord& record) {
        return record.name == name && record.state == state;
    });
}

TEST(BareScenes, NothingThatFollowsPhotonsRunsWithoutLightSpecularSurfaceOrReceiver) {
    for (const std::string& parts : {kFloor + kWater, kLight + kFloor, kLight + kWater}) {
        const Frame frame(sceneWith(parts), 64, 48);
        EXPECT_EQ(sum(frame.causticIrradiance()), 0.0);
        EXPECT_TRUE(hasPass(frame, "trace.hierarchical", graph::PassState::skipped));
        EXPECT_TRUE(hasPass(frame, "layers.peel", graph::PassState::culled));
        EXPECT_TRUE(hasPass(frame, "compose.display", graph::PassState::ran));
    }
}

}  // namespace
}  // namespace kaustik::test
