// SPDX-License-Identifier: MIT
// Maps of lights as a whole: levels of resolution (WD08, section 4), and that neither runs,
// batches, sizes nor numbers of photons change their light.
#include <string>
#include <utility>
#include <vector>

#include "tests/gpu/techniques/sheet_light.h"

namespace kaustik::test {
namespace {

using namespace transport;

const Settings kLevels{{"reconstruct", "levels"}, {"filter", "levels"}};

// Levels of 96 texels: 96, 48, 24, 12; the coarser ones side by side.
TEST(Levels, HaveAllFluxEach) {
    const scene::Scene scene = waves();
    for (const char* diameter : {"1", "3", "8"}) {
        for (const int size : {96, 77}) {
            const MapFrame frame(
                scene, "caustic_map",
                with(with(kSmall, kLevels), {{"reconstruct.levels.diameter", diameter},
                                             {"reconstruct.map_size", std::to_string(size)}}));
            const double stored = frame.watts(kAccountDeposited);
            EXPECT_GT(stored, 0.0);
            EXPECT_NEAR(storedIn(frame, 0).sum().g, stored, kFlux * stored);
            const MapTexels coarser = storedIn(frame, 1);
            int first = 0;
            int levels = 0;
            for (int side = (size + 1) / 2; size >> (levels + 1) >= 8; side = (side + 1) / 2) {
                double sum = 0.0;
                for (int y = 0; y < side; ++y) {
                    for (int x = first; x < first + side; ++x)
                        sum += coarser.at(x, y).g;
                }
                ++levels;
                // What the border clips of splats grows with the texels.
                const double clipped = std::string(diameter) == "1" ? kFlux : 0.03;
                EXPECT_NEAR(sum, stored, clipped * stored) << levels << " of " << size;
                EXPECT_LE(sum, stored * (1.0 + kFlux)) << levels << " of " << size;
                first += side;
            }
            EXPECT_EQ(levels, 3);
            frame.expectBalance();
        }
    }
}

TEST(Levels, OfPointsAreTheMipChainToTheBit) {
    const scene::Scene scene = waves();
    for (const char* size : {"96", "77"}) {
        const auto render = [&](const char* source) {
            return MapFrame(scene, "caustic_map",
                            with(with(kSmall, kLevels), {{"reconstruct.levels.diameter", "1"},
                                                         {"reconstruct.map_size", size},
                                                         {"filter.levels.from", source}}));
        };
        const MapFrame splats = render("splats");
        const MapFrame mip = render("mip");
        EXPECT_EQ(splats.words(), mip.words()) << size;
        EXPECT_EQ(splats.counts(1), mip.counts(1)) << size;
        EXPECT_EQ(largestDifference(splats.filtered(), mip.filtered()), 0.0) << size;
    }
}

TEST(Levels, OfUniformLightGiveItsIrradiance) {
    const scene::Scene scene = uniform();
    for (const char* source : {"splats", "mip"}) {
        const MapFrame frame(scene, "caustic_map",
                             with(kLevels, {{"emit.photons", "128x128"},
                                            {"reconstruct.map_size", "128"},
                                            {"reconstruct.map_covers", "scene"},
                                            {"filter.levels.from", source}}));
        // Four photons a texel, sixteen on one of the level beyond: that one is taken.
        const Field field = fieldOf(frame, frame.filtered(), 1000.0);
        EXPECT_NEAR(field.mean, 1000.0, 5.0);
        EXPECT_LT(field.worst, 0.05);
    }
}

// Nodes that store light in maps, with everything that they need besides.
const std::vector<std::pair<std::string, Settings>> kAll{
    {"fixed", {{"reconstruct", "fixed"}}},
    {"blur", {{"reconstruct", "fixed"}, {"filter", "blur"}}},
    {"four_radii", {{"reconstruct", "four_radii"}, {"filter", "blend"}}},
    {"levels", kLevels},
    {"lens", {{"reconstruct", "lens"}}},
    {"sprites", {{"reconstruct", "sprites"}}},
    {"triangles", {{"reconstruct", "triangles"}}},
    {"beams", {{"reconstruct", "beams"}}}};

TEST(Maps, AreTheSameToTheBitInEveryRun) {
    const scene::Scene scene = waves();
    for (const auto& [name, settings] : kAll) {
        const MapFrame first(scene, "caustic_map", with(kSmall, settings));
        const MapFrame second(scene, "caustic_map", with(kSmall, settings));
        EXPECT_GT(first.watts(kAccountDeposited), 100.0) << name;
        EXPECT_EQ(first.words(), second.words()) << name;
        first.expectBalance();
    }
}

TEST(Maps, OfBatchesAreThoseOfAllPhotonsAtOnceToTheBit) {
    const scene::Scene scene = waves();
    for (const auto& [name, settings] : kAll) {
        // Those that join the photons of neighbouring cells share what two batches bring.
        if (name == "triangles" || name == "beams") continue;
        const MapFrame all(scene, "caustic_map", with(kSmall, settings));
        for (const char* batch : {"1000", "4096"}) {
            const MapFrame parts(scene, "caustic_map",
                                 with(with(kSmall, settings), {{"emit.batch", batch}}));
            EXPECT_EQ(all.words(), parts.words()) << name << " " << batch;
        }
    }
}

TEST(Maps, OfAllSizesHoldAllLight) {
    const scene::Scene scene = uniform();
    for (const char* size : {"16", "17", "1000", "4096"}) {
        for (const auto& settings :
             {Settings{{"reconstruct", "fixed"}},
              Settings{{"reconstruct", "four_radii"}, {"filter", "blend"}}, kLevels}) {
            if (std::string(size).size() > 2 && settings.front().second != "fixed") continue;
            const MapFrame frame(scene, "caustic_map",
                                 with(settings, {{"emit.photons", "32x32"},
                                                 {"reconstruct.map_size", size},
                                                 {"reconstruct.map_covers", "scene"}}));
            EXPECT_EQ(frame.map().on.views->width(), std::stoi(size));
            EXPECT_NEAR(frame.watts(kAccountDeposited), 4000.0, 1e-3 * 4000.0);
            EXPECT_TRUE(frame.renderer().warnings().empty());
            frame.expectBalance();
        }
    }
}

TEST(Maps, ThatDoNotFitAreHalvedAndTheReportSaysSo) {
    const scene::Scene scene = uniform();
    const MapFrame frame(scene, "caustic_map",
                         {{"emit.photons", "32x32"},
                          {"reconstruct.map_size", "1024"},
                          {"reconstruct.map_memory", "1"}});
    const int width = frame.map().on.views->width();
    // 24 bytes a texel are the sums alone.
    EXPECT_LE(24.0 * width * width, 1048576.0);
    EXPECT_GE(width, 64);
    ASSERT_EQ(frame.renderer().warnings().size(), 1U);
    EXPECT_NE(frame.renderer().warnings().front().find("reconstruct.map_memory"),
              std::string::npos);
    frame.expectBalance();
}

TEST(Photons, OfAllNumbersBringTheSameLight) {
    const scene::Scene scene = uniform();
    for (const char* photons : {"32x32", "513x7", "2048x2048"}) {
        const MapFrame frame(scene, "caustic_map",
                             {{"emit.photons", photons},
                              {"reconstruct.map_size", "256"},
                              {"reconstruct.fixed.diameter", "1"}});
        EXPECT_NEAR(frame.watts(kAccountArrived), 4000.0, 1e-3 * 4000.0) << photons;
        frame.expectBalance();
    }
}

}  // namespace
}  // namespace kaustik::test
