// SPDX-License-Identifier: MIT
// A sheet shows only the side that the eye looks at: light that arrives at its back lights nothing
// that is seen, and is in the ledger as occluded.
#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/techniques/caustic_map_frame.h"

namespace kaustik::test {
namespace {

using namespace transport;

// Light from below through still water onto a sheet one metre above it.
scene::Scene litFromBelow(const std::string& eye) {
    return sceneFromText(R"(
name = "sheet"
[camera]
position = )" + eye + R"(
target = [0, 1, 0]
up = [0, 0, -1]
[[light]]
name = "lamp"
type = "directional"
direction = [0, 1, 0]
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
name = "sheet"
shape = "plane"
material = "chalk"
size = [4, 4]
position = [0, 1, 0]
[[object]]
name = "water"
shape = "water"
material = "water"
size = [1, 1]
cells = [4, 4]
)");
}

double brightest(const Texels& irradiance) {
    float maximum = 0.0f;
    for (const float value : irradiance.values)
        maximum = std::max(maximum, value);
    return static_cast<double>(maximum);
}

TEST(ReceiverSide, ThatIsLitIsSeenFromWhereTheLightComesFrom) {
    const scene::Scene scene = litFromBelow("[0, -2, 0.01]");
    const Frame frame(scene, 120, 90, {{"emit.photons", "64x64"}});
    EXPECT_GT(brightest(frame.causticIrradiance()), 900.0);
}

TEST(ReceiverSide, ThatIsDarkStaysDark) {
    const scene::Scene scene = litFromBelow("[0, 4, 0.01]");
    const Frame frame(scene, 120, 90, {{"emit.photons", "64x64"}});
    EXPECT_EQ(brightest(frame.causticIrradiance()), 0.0);
    const EnergyLedger ledger = frame.renderer().ledger();
    EXPECT_GT(ledger.watts[kAccountArrived], 0.0);
    // Both are sums of the same photons in the same fixed point.
    EXPECT_EQ(ledger.watts[kAccountOccludedSplat], ledger.watts[kAccountArrived]);
}

TEST(ReceiverSide, OfDirectLightIsTheEyesToo) {
    // Beside the water's shadow the lamp lights the sheet's underside.
    for (const auto& [eye, lit] : {std::pair{"[0, -2, 0.01]", 1000.0}, {"[0, 4, 0.01]", 0.0}}) {
        const scene::Scene scene = litFromBelow(eye);
        const Frame frame(scene, 120, 90, {{"emit.photons", "64x64"}}, {"direct.irradiance"});
        // The lamp stands straight below: its irradiance, in 32-bit arithmetic.
        EXPECT_NEAR(brightest(frame.read("direct.irradiance")), lit, 1e-2) << eye;
    }
}

// A slab thinner than a splat, lit from behind: its front is the eye's, its back is hidden by it.
TEST(ReceiverSide, ThatABodyItselfHidesIsOccludedAndNotEdgeOn) {
    const scene::Scene scene = sceneFromText(R"(
name = "slab"
[camera]
position = [0, 0.6, 4]
target = [0, 0, 0]
[[light]]
name = "lamp"
type = "directional"
direction = [0, 0, 1]
irradiance = 1000
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "pane"
type = "dielectric"
ior = 1
[[object]]
name = "slab"
shape = "box"
material = "chalk"
size = [1, 1, 0.02]
[[object]]
name = "pane"
shape = "plane"
material = "pane"
size = [0.5, 0.5]
position = [0, 0, -1]
rotation_degrees = [90, 0, 0]
)");
    std::vector<Settings> reconstructions{{{"reconstruct", "triangles"}},
                                          {{"reconstruct", "beams"}}};
    for (const char* shape : {"beam", "disc", "screen"}) {
        reconstructions.push_back(
            {{"reconstruct", "sprites"}, {"reconstruct.sprites.shape", shape}});
    }
    for (Settings settings : reconstructions) {
        const std::string which = settings.front().second + " " + settings.back().second;
        settings.emplace_back("emit.photons", "16x16");
        const Frame frame(scene, 160, 120, settings);
        const EnergyLedger ledger = frame.renderer().ledger();
        // 1000 W/m² on a quarter of a square metre, in 32-bit products.
        EXPECT_NEAR(ledger.watts[kAccountArrived], 250.0, 1e-3) << which;
        EXPECT_EQ(ledger.watts[kAccountEdgeOn], 0.0) << which;
        EXPECT_EQ(ledger.watts[kAccountOccludedSplat], ledger.watts[kAccountArrived]) << which;
    }
}

// A mirror sends light to the back of a sheet, of which a map with six faces sees the front: a
// splat that reaches from one face into the next is not stored by half.
TEST(ReceiverSide, ThatAMapDoesNotSeeGetsNothingFromAnyOfItsFaces) {
    if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    const scene::Scene scene = numerics::makeScene(
        {{0, 6, 6}, {0, 0, 0}},
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = 100\n" +
            numerics::object("floor", "plane", "mirror", {0, 0, 0}, "size = [8, 8]") +
            numerics::object("sheet", "plane", "grey", {2.5, 1, 0}, "size = [3, 8]"));
    for (const char* diameter : {"1", "7"}) {
        SCOPED_TRACE(diameter);
        const MapFrame frame(scene, "caustic_map",
                             {{"emit.photons", "128x128"},
                              {"trace", "raytraced"},
                              {"specular", "interface"},
                              {"reconstruct.map_size", "64"},
                              {"reconstruct.fixed.diameter", diameter}});
        ASSERT_EQ(frame.map().on.views->count(), 6);
        frame.expectBalance();
        EXPECT_GT(frame.watts(kAccountHiddenInMap), 1.0);
        EXPECT_EQ(frame.watts(kAccountDeposited), 0.0);
    }
}

}  // namespace
}  // namespace kaustik::test
