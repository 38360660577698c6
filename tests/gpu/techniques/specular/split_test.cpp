// SPDX-License-Identifier: MIT
// specular.split: which branches are followed keeps neighbouring photons together, so that what
// they light has no gaps, and depends on nothing but the photon's own path.
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace transport;

// A ball over paper, seen from straight above; what it reflects outside misses the paper or comes
// down far away.
scene::Scene ballOverPaper() {
    return sceneFromText(R"(
name = "ball"
[camera]
position = [0, 4, 0]
target = [0, 0, 0]
up = [0, 0, -1]
vertical_fov_degrees = 30
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "paper"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "paper"
shape = "plane"
material = "paper"
size = [6, 6]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.5
position = [0, 0.8, 0]
segments = 192
)");
}

// How many pixels are darker than `factor` of the least of their neighbours, where all of these
// have more than `lit`, W/m².
int gapsIn(const Texels& irradiance, double factor, double lit) {
    int gaps = 0;
    int judged = 0;
    for (int y = 1; y + 1 < irradiance.height; ++y) {
        for (int x = 1; x + 1 < irradiance.width; ++x) {
            double least = 1e30;
            for (int i = 0; i < 9; ++i) {
                if (i == 4) continue;
                least = std::min(least, irradiance.rgb(x + i % 3 - 1, y + i / 3 - 1).g);
            }
            if (!(least > lit)) continue;
            ++judged;
            gaps += irradiance.rgb(x, y).g < factor * least ? 1 : 0;
        }
    }
    EXPECT_GT(judged, 1000);
    return gaps;
}

// With the exact tracer, so that nothing is missing for want of a layer.
class FollowedBranches : public ::testing::Test {
  protected:
    void SetUp() override {
        if (lacksExactTracer()) GTEST_SKIP() << "Embree is not there.";
    }
};

TEST_F(FollowedBranches, LeaveNoGapsInASmoothField) {
    const scene::Scene scene = ballOverPaper();
    const Frame frame(scene, 240, 180,
                      {{"specular", "split"}, {"trace", "raytraced"}, {"emit.photons", "96x96"}});
    const Texels irradiance = frame.causticIrradiance();
    // Of a sun of 1000. What has come through near the ball's rim lies next to each other in beams,
    // and changes from one to the next.
    EXPECT_EQ(gapsIn(irradiance, 0.7, 1.0), 0);
    EXPECT_EQ(gapsIn(irradiance, 0.9, 30.0), 0);
}

// Twice reflected within is what a ball has least of: R² and less.
TEST_F(FollowedBranches, OfABallAreFollowedAsFarAsTheyAreWorthIt) {
    const scene::Scene scene = ballOverPaper();
    double before = 1.0;
    for (const char* levels : {"0", "1", "2", "3"}) {
        const Frame frame(scene, 160, 120,
                          {{"specular.split.levels", levels},
                           {"specular", "split"},
                           {"trace", "raytraced"},
                           {"emit.photons", "64x64"}});
        const EnergyLedger ledger = frame.renderer().ledger();
        const double untraced =
            ledger.watts[kAccountUntracedBranch] / ledger.watts[kAccountEmitted];
        EXPECT_LE(untraced, before) << levels;
        EXPECT_LE(std::abs(ledger.balance()), 1e-6) << levels;
        before = untraced;
    }
    EXPECT_LT(before, 0.01);
}

TEST_F(FollowedBranches, DependOnNoSeedAndNoBatch) {
    const scene::Scene scene = ballOverPaper();
    const auto watts = [&](const char* batch) {
        const Frame frame(scene, 160, 120,
                          {{"specular", "split"},
                           {"trace", "raytraced"},
                           {"emit.photons", "48x48"},
                           {"emit.batch", batch}});
        EXPECT_FALSE(frame.renderer().isRandom());
        return frame.renderer().ledger().watts;
    };
    const auto whole = watts("4194304");
    const auto parts = watts("3000");
    for (const unsigned account : {kAccountEmitted, kAccountArrived, kAccountUntracedBranch})
        EXPECT_EQ(whole[account], parts[account]) << account;
}

// Room for all that photons may become comes out of the batch, so that the lists stay within it.
TEST_F(FollowedBranches, LeaveListsWithinTheBatch) {
    const scene::Scene scene = ballOverPaper();
    const Frame frame(scene, 160, 120,
                      {{"specular", "split"},
                       {"specular.split.levels", "3"},
                       {"emit.photons", "64x64"},
                       {"emit.batch", "16384"}});
    for (const std::string& name : frame.renderer().graph().resourceNames()) {
        if (!name.starts_with("photons.position")) continue;
        const auto& desc = std::get<graph::TextureDesc>(
            frame.renderer().graph().descOf(frame.renderer().graph().find(name)));
        // Rows of the neighbouring batches come on top.
        EXPECT_LE(desc.width * desc.height, 16384 + 8 * 2 * kJoinedRows * 64) << name;
    }
}

}  // namespace
}  // namespace kaustik::test
