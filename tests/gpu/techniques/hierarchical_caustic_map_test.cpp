// SPDX-License-Identifier: MIT
// Hierarchical caustic maps (W08) and maps of several resolutions: which photons there are, and
// that nothing of their light is lost or doubled, whatever the batches.
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/gpu/techniques/ball_maps.h"

namespace kaustik::test {
namespace {

using namespace transport;
using glm::dvec3;

TEST(HierarchicalMaps, OfToleranceZeroAreTheDenseGrids) {
    const scene::Scene scene =
        ballScene(lamp("lamp", {0.5, 3.0, 0.3}) + lamp("other", {-1.0, 2.5, 0.8}));
    const MapFrame dense = gridded(scene, "caustic_map", {});
    const MapFrame whole = gridded(scene, "hierarchical_caustic_map", {{"refine.tolerance", "0"}});
    EXPECT_EQ(dense.words(), whole.words());
    EXPECT_EQ(countsOf(whole).merged, 0u);
}

TEST(HierarchicalMaps, StoreAllLightInFewerPhotons) {
    const scene::Scene scene =
        ballScene(lamp("lamp", {0.5, 3.0, 0.3}) + lamp("other", {-1.0, 2.5, 0.8}));
    const MapFrame dense = gridded(scene, "caustic_map", {});
    const MapFrame merged = gridded(scene, "hierarchical_caustic_map", {});
    EXPECT_LT(countsOf(merged).emitted, countsOf(merged).probes / 2);
    EXPECT_NEAR(merged.watts(kAccountDeposited), dense.watts(kAccountDeposited),
                1e-3 * dense.watts(kAccountDeposited));
    merged.expectBalance();
    // Whole squares of cells in every batch.
    const MapFrame parts = gridded(scene, "hierarchical_caustic_map", {{"emit.batch", "16384"}});
    EXPECT_EQ(merged.words(), parts.words());
}

// Squares of 2^level by 2^level of 256 x 256 cells that hold photons which arrive.
std::set<std::pair<unsigned, unsigned>> squaresOf(const std::vector<MapPhoton>& photons,
                                                  unsigned level) {
    std::set<std::pair<unsigned, unsigned>> squares;
    for (const MapPhoton& photon : photons) {
        if (photon.hitFate == kFateReceiver)
            squares.emplace((photon.cell % 256) >> level, (photon.cell / 256) >> level);
    }
    return squares;
}

TEST(HierarchicalMaps, AreWalkedOverTheSquaresThatHoldPhotonsFromTheTopDown) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const Settings coarse = {{"reconstruct.map_size", "16"}};
    const std::vector<MapPhoton> dense = gridded(scene, "caustic_map", coarse).photons();
    const CellCounts all = countsOf(
        gridded(scene, "hierarchical_caustic_map", with(coarse, {{"refine.tolerance", "0"}})));
    for (unsigned level = 0; level < kSquareLevels; ++level) {
        const std::size_t wanted = level <= 8 ? squaresOf(dense, level).size() : 0;
        EXPECT_EQ(all.squares[level], wanted) << level;
    }
    EXPECT_EQ(all.probes, all.emitted);
    // One photon will do for whatever lies in the map: only the squares of 64 x 64 cells, the
    // coarsest that may be one, and those above are looked at, but for squares with one photon
    // alone.
    const MapFrame merged =
        gridded(scene, "hierarchical_caustic_map", with(coarse, {{"refine.tolerance", "64"}}));
    const CellCounts few = countsOf(merged);
    EXPECT_EQ(few.squares[8], all.squares[8]);
    EXPECT_EQ(few.squares[7], all.squares[7]);
    EXPECT_EQ(few.squares[6], all.squares[6]);
    EXPECT_EQ(few.emitted, few.merged + few.squares[0]);
    EXPECT_EQ(few.probes, all.probes);
    unsigned looks = 0;
    for (const unsigned squares : few.squares)
        looks += squares;
    // Of what a walk for each photon would look at.
    EXPECT_LT(looks, few.probes * 8 / 50);
    merged.expectBalance();
}

// Merged photons that diverge are in coarser levels, whatever the batches.
TEST(HierarchicalMaps, EndInAMapOfSeveralResolutions) {
    const scene::Scene scene =
        ballScene(lamp("lamp", {0.5, 3.0, 0.3}) + lamp("other", {-1.0, 2.5, 0.8}));
    const Settings levels = {
        {"reconstruct", "multi_level"}, {"filter", "level_sum"}, {"reconstruct.map_size", "512"}};
    const MapFrame dense = gridded(scene, "caustic_map", levels);
    const MapFrame whole = gridded(scene, "hierarchical_caustic_map", levels);
    EXPECT_GT(countsOf(whole).merged, 100u);
    EXPECT_GT(storedIn(whole, 1).sum().g, 0.01 * storedIn(whole, 0).sum().g);
    EXPECT_NEAR(whole.watts(kAccountDeposited), dense.watts(kAccountDeposited),
                1e-3 * dense.watts(kAccountDeposited));
    whole.expectBalance();
    const MapFrame parts =
        gridded(scene, "hierarchical_caustic_map", with(levels, {{"emit.batch", "16384"}}));
    EXPECT_EQ(whole.words(), parts.words());
    // Squares that lie in one batch are the same.
    for (int level = 0; level <= 6; ++level)
        EXPECT_EQ(countsOf(whole).squares[level], countsOf(parts).squares[level]) << level;
    const MapFrame apart =
        gridded(scene, "hierarchical_caustic_map", with(levels, {{"refine.tolerance", "0"}}));
    EXPECT_EQ(apart.words(), dense.words());
}

// What coarser levels hold comes back as it was stored.
TEST(MultiLevelMaps, KeepTheirLight) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const MapFrame frame(scene, "adaptive_caustic_map",
                         {{"refine.finest", "64"},
                          {"refine.start", "16"},
                          {"refine.check", "32"},
                          {"reconstruct.map_size", "256"},
                          {"reconstruct", "multi_level"},
                          {"filter", "level_sum"}});
    const dvec3 fine = storedIn(frame, 0).sum();
    const dvec3 coarse = storedIn(frame, 1).sum();
    EXPECT_GT(coarse.g, 0.1 * fine.g);
    EXPECT_NEAR(frame.filtered().sum().g, fine.g + coarse.g, 1e-3 * (fine.g + coarse.g));
    frame.expectBalance();
}

}  // namespace
}  // namespace kaustik::test
