// SPDX-License-Identifier: MIT
// Adaptive caustic maps (WN09): which photons there are, that nothing of
// their light is lost or doubled, and that neither batches nor the way in which they are chosen
// change anything.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "framework/core/error.h"
#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/techniques/ball_maps.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

// Of 256 x 256 cells, of which the metric is asked from 32 x 32 on.
MapFrame adaptive(const scene::Scene& scene, const Settings& more) {
    return {scene, "adaptive_caustic_map",
            with({{"refine.finest", "256"},
                  {"refine.start", "16"},
                  {"refine.check", "32"},
                  {"emit.deferred.size", "256"},
                  {"reconstruct.map_size", "128"}},
                 more)};
}

// Photons by where they enter and what they carry, however they are ordered.
using Entry = std::tuple<double, double, double, double>;
std::multiset<Entry> entriesOf(const MapFrame& frame) {
    std::multiset<Entry> entries;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.fate != kFateInFlight) continue;
        entries.emplace(photon.entry.x, photon.entry.y, photon.entry.z, photon.entryFlux.g);
    }
    return entries;
}

TEST(AdaptivePhotons, OfMaximalTraversalAreTheDenseGrids) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const MapFrame all = adaptive(scene, {{"refine.metric", "traversal"}});
    const MapFrame dense = gridded(scene, "caustic_map", {});
    EXPECT_EQ(entriesOf(all), entriesOf(dense));
    EXPECT_EQ(all.words(), dense.words());
    EXPECT_GT(entriesOf(all).size(), 10000u);
    all.expectBalance();
}

TEST(AdaptivePhotons, OfToleranceZeroAreThoseOfMaximalTraversal) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    EXPECT_EQ(adaptive(scene, {{"refine.tolerance", "0"}}).words(),
              adaptive(scene, {{"refine.metric", "traversal"}}).words());
}

TEST(AdaptivePhotons, DependNeitherOnBatchesNorOnTheWayInWhichTheyAreChosen) {
    const scene::Scene scene =
        ballScene(lamp("lamp", {0.5, 3.0, 0.3}) + lamp("other", {-1.0, 2.5, 0.8}));
    for (const char* metric : {"map", "eye", "traversal"}) {
        SCOPED_TRACE(metric);
        const MapFrame whole = adaptive(scene, {{"refine.metric", metric}});
        EXPECT_EQ(countsOf(whole).batches, 1u);
        const MapFrame parts = adaptive(scene, {{"refine.metric", metric}, {"refine.memory", "1"}});
        EXPECT_GT(countsOf(parts).batches, 2u);
        EXPECT_EQ(whole.words(), parts.words());
        EXPECT_EQ(countsOf(whole).emitted, countsOf(parts).emitted);
        const MapFrame captured =
            adaptive(scene, {{"refine.metric", metric}, {"refine", "feedback"}});
        EXPECT_EQ(whole.words(), captured.words());
        EXPECT_EQ(entriesOf(whole), entriesOf(captured));
        const CellCounts counts = countsOf(whole), noted = countsOf(captured);
        EXPECT_GT(counts.discarded, 0u);
        EXPECT_GT(counts.deepest, 0u);
        EXPECT_EQ(counts.probes, noted.probes);
        EXPECT_EQ(counts.merged, noted.merged);
        EXPECT_EQ(counts.discarded, noted.discarded);
        EXPECT_EQ(counts.deepest, noted.deepest);
        EXPECT_LE(std::abs(parts.renderer().ledger().balance()), 1e-6);
    }
}

// Squares of pixels that keep wide beams' light are made once, however often a loop comes by.
TEST(AdaptivePhotons, LeaveTheLightOfWideBeamsInSquaresUntilTheLastBatch) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const auto rendered = [&](const char* memory) {
        const Settings settings = {{"refine.finest", "128"},     {"refine.start", "16"},
                                   {"refine.check", "32"},       {"refine.metric", "traversal"},
                                   {"refine.memory", memory},    {"emit.deferred.size", "256"},
                                   {"reconstruct", "triangles"}, {"reconstruct.space", "screen"},
                                   {"gather", "screen"}};
        return Frame(scene, 400, 300, settings, {}, false, "adaptive_caustic_map");
    };
    const Frame whole = rendered("64");
    const Frame parts = rendered("1");
    const auto batches = [](const Frame& frame) {
        return frame.renderer()
            .buffer(frame.renderer().outputs().cells)
            .read<CellCounts>()
            .front()
            .batches;
    };
    EXPECT_EQ(batches(whole), 1u);
    EXPECT_GT(batches(parts), 1u);
    EXPECT_GT(whole.causticIrradiance().sum(), 0.0);
    EXPECT_EQ(whole.causticIrradiance().values, parts.causticIrradiance().values);
    EXPECT_LE(std::abs(whole.renderer().ledger().balance()), 1e-6);
    EXPECT_LE(std::abs(parts.renderer().ledger().balance()), 1e-6);
}

// What is drawn at random is drawn by the cell, of a probe as of a photon.
TEST(AdaptivePhotons, ThatDrawAtRandomDependOnNoBatchesEither) {
    const scene::Scene scene =
        ballScene(lamp("lamp", {0.5, 3.0, 0.3}) + lamp("other", {-1.0, 2.5, 0.8}));
    for (const char* levels : {"1", "3"}) {
        SCOPED_TRACE(levels);
        const Settings drawn = {
            {"specular", "split"}, {"specular.split.levels", levels}, {"trace", "hierarchical"}};
        const MapFrame whole = adaptive(scene, drawn);
        EXPECT_EQ(countsOf(whole).batches, 1u);
        const MapFrame parts = adaptive(scene, with(drawn, {{"refine.memory", "1"}}));
        EXPECT_GT(countsOf(parts).batches, 2u);
        EXPECT_EQ(countsOf(whole).emitted, countsOf(parts).emitted);
        EXPECT_EQ(countsOf(whole).merged, countsOf(parts).merged);
        EXPECT_EQ(whole.words(), parts.words());
        EXPECT_EQ(whole.renderer().ledger().watts, parts.renderer().ledger().watts);
    }
}

// Each photon that stands for four carries what they would have carried.
TEST(AdaptivePhotons, ThatStandForSeveralCarryAllOfTheirLight) {
    for (const std::string& light : {lamp("lamp", {0.5, 3.0, 0.3}), sun({0.2, -1.0, 0.1})}) {
        const scene::Scene scene = ballScene(light);
        const MapFrame all = adaptive(scene, {{"refine.metric", "traversal"}});
        for (const char* metric : {"map", "eye"}) {
            const MapFrame some = adaptive(scene, {{"refine.metric", metric}});
            // To what the lamp's falloff differs by within a cell of 32 x 32.
            EXPECT_NEAR(some.watts(kAccountEmitted), all.watts(kAccountEmitted),
                        1e-4 * all.watts(kAccountEmitted))
                << metric;
            EXPECT_LT(countsOf(some).emitted, countsOf(all).emitted / 2);
            EXPECT_GT(countsOf(some).merged, 0u);
            some.expectBalance();
        }
    }
}

// No four photons that became one were further apart than the tolerance: those of the finest cells
// arrive within it of the one that stands for them, and a texel's light stays in its neighbours.
TEST(AdaptivePhotons, MoveLightNoFartherThanTheTolerance) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const Settings points{{"reconstruct.fixed.diameter", "1"}};
    const MapTexels all = storedIn(adaptive(scene, with(points, {{"refine.metric", "traversal"}})));
    const MapTexels some = storedIn(adaptive(scene, points));
    // What four by four texels hold differs by what goes over their border.
    double moved = 0.0;
    for (int y = 0; y + 8 <= all.height; y += 8) {
        for (int x = 0; x + 8 <= all.width; x += 8) {
            double difference = 0.0;
            for (int i = 0; i < 64; ++i)
                difference += (some.at(x + i % 8, y + i / 8) - all.at(x + i % 8, y + i / 8)).g;
            moved += 0.5 * std::abs(difference);
        }
    }
    EXPECT_LT(moved, 0.05 * all.sum().g);
    // At the rim, where light is totally reflected or is not, one photon tells for four.
    EXPECT_NEAR(some.sum().g, all.sum().g, 5e-3 * all.sum().g);
}

// A glass wire narrower than a start cell, which the middles of the coarse cells miss.
TEST(AdaptivePhotons, FindAWireThinnerThanACellByTheMask) {
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) + kFloor + kBall +
                    object("wire", "cylinder", "glass", {0.93, 0.6, 0},
                           "radius = 0.008\nheight = 1.0\nrotation_degrees = [90, 0, 0]"));
    const Settings coarse{{"refine.metric", "traversal"},
                          {"refine.start", "8"},
                          {"refine.finest", "512"},
                          {"emit.deferred.size", "512"}};
    const auto inWire = [](const MapFrame& frame) {
        int photons = 0;
        for (const MapPhoton& photon : frame.photons())
            photons += photon.fate == kFateInFlight && photon.entry.x > 0.6 ? 1 : 0;
        return photons;
    };
    const int masked = inWire(adaptive(scene, with(coarse, {{"refine.mask", "on"}})));
    const int unmasked = inWire(adaptive(scene, with(coarse, {{"refine.mask", "off"}})));
    const MapFrame dense =
        gridded(scene, "caustic_map", {{"emit.photons", "512x512"}, {"emit.deferred.size", "512"}});
    EXPECT_GT(inWire(dense), 500);
    EXPECT_EQ(masked, inWire(dense));
    EXPECT_LT(unmasked, masked);
}

// Light that falls on two things stays apart where a single one would take one photon.
TEST(AdaptivePhotons, OfPathsThatPartStayApart) {
    const scene::Scene scene = makeScene(
        kAbove, lamp("lamp", {0.0, 3.0, 0.0}) + kBall +
                    "[[material]]\nname = \"other\"\ntype = \"lambertian\"\nalbedo = 0.3\n" +
                    object("left", "plane", "grey", {-1.5, 0, 0}, "size = [3, 6]") +
                    object("right", "plane", "other", {1.5, 0, 0}, "size = [3, 6]"));
    const MapFrame apart = adaptive(scene, {});
    const MapFrame together = adaptive(scene, {{"refine.signature", "off"}});
    EXPECT_GT(countsOf(apart).emitted, countsOf(together).emitted);
}

TEST(AdaptivePhotons, OfSeveralLightsLieInTheirOwnMaps) {
    const std::string first = lamp("lamp", {0.5, 3.0, 0.3});
    const std::string second = lamp("other", {-1.0, 2.5, 0.8});
    const scene::Scene lit = ballScene(first + second);
    const scene::Scene litOnce = ballScene(first);
    const scene::Scene litToo = ballScene(second);
    const MapFrame both = adaptive(lit, {});
    const MapTexels ofFirst = storedIn(both, 0, 0, 0);
    const MapTexels ofSecond = storedIn(both, 0, 0, 1);
    const dvec3 alone = storedIn(adaptive(litOnce, {})).sum();
    const dvec3 aloneToo = storedIn(adaptive(litToo, {})).sum();
    EXPECT_NEAR(ofFirst.sum().g, alone.g, 1e-6 * alone.g);
    EXPECT_NEAR(ofSecond.sum().g, aloneToo.g, 1e-6 * aloneToo.g);
}

// Of more lights than a word has bits each has a mask of its own: here one that shines on
// the ball, first or last among many that shine on the floor alone.
TEST(AdaptivePhotons, OfManyLightsDoNotDependOnTheirOrder) {
    constexpr int kDark = 33;
    std::string dark;
    for (int i = 0; i < kDark; ++i)
        dark += lamp(fmt::format("dark {}", i), {1.8, 1.0 + 0.01 * i, 1.8}, {0.0, -1.0, 0.0});
    const std::string bright = lamp("bright", {0.5, 3.0, 0.3});
    const Settings coarse = {{"refine.finest", "64"},
                             {"emit.deferred.size", "64"},
                             {"reconstruct.map_size", "64"},
                             {"shadow.map.size", "64"}};
    const CellCounts first = countsOf(adaptive(ballScene(bright + dark), coarse));
    const CellCounts last = countsOf(adaptive(ballScene(dark + bright), coarse));
    EXPECT_GT(first.emitted, 100u);
    EXPECT_EQ(first.emitted, last.emitted);
    EXPECT_EQ(first.probes, last.probes);
    EXPECT_EQ(first.discarded, last.discarded);
}

// Between texels of coarse buffers photons start on the triangles that these see, or on a smooth
// surface between them: how far off the ball, in its radius.
TEST(AdaptivePhotons, StartOnTheSurfaceBetweenTexels) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const dvec3 center(0, 0.8, 0);
    const dvec3 along = glm::normalize(center - dvec3(0.5, 3.0, 0.3));
    std::map<std::string, double> worst;
    std::map<std::string, double> worstInTheMiddle;
    for (const char* lookup : {"triangle", "interpolated"}) {
        const MapFrame frame = gridded(
            scene, "caustic_map", {{"emit.deferred.size", "64"}, {"emit.deferred.lookup", lookup}});
        for (const MapPhoton& photon : frame.photons()) {
            if (photon.fate != kFateInFlight) continue;
            const dvec3 entry = (photon.entry - center) / 0.4;
            const double off = std::abs(glm::length(entry) - 1.0);
            worst[lookup] = std::max(worst[lookup], off);
            if (glm::length(entry - glm::dot(entry, along) * along) < 0.85)
                worstInTheMiddle[lookup] = std::max(worstInTheMiddle[lookup], off);
        }
    }
    // The mesh itself is off by 1 - cos(pi / 48) along either side of its quads, and more across.
    EXPECT_LT(worstInTheMiddle["triangle"], 0.0065);
    // Where the light sees it at a slant, half a texel is 2 cm of a triangle's plane that goes on
    // past its edge, from which the next one turns by 2 pi / 48 and more.
    EXPECT_LT(worst["triangle"], 0.02);
    EXPECT_LT(worst["interpolated"], 0.05);
}

TEST(DeferredEmission, DrawnOnceIsDrawnTwice) {
    // Where fronts are exact, so are photons; backs may be rounded otherwise behind a geometry
    // shader.
    for (const std::string& light : {sun({0.2, -1.0, 0.1}), lamp("lamp", {0.5, 3.0, 0.3})}) {
        const scene::Scene scene = ballScene(light);
        const MapFrame once = adaptive(scene, {{"emit.deferred.geometry", "once"}});
        const MapFrame twice = adaptive(scene, {{"emit.deferred.geometry", "twice"}});
        EXPECT_NEAR(static_cast<double>(countsOf(once).emitted), countsOf(twice).emitted,
                    2e-3 * countsOf(twice).emitted);
        const double ofTwice = storedIn(twice).sum().g;
        EXPECT_NEAR(storedIn(once).sum().g, ofTwice, 1e-4 * ofTwice);
    }
}

TEST(AdaptiveMedium, ScattersWhatADenseGridScatters) {
    const std::string fog = "[medium]\nscattering_per_meter = 0.08\nabsorption_per_meter = 0.01\n";
    const scene::Scene scene =
        makeScene(kAbove, fog + lamp("lamp", {0.5, 3.0, 0.3}) + kFloor + kBall);
    const Registry registry = registerAll();
    const auto scattered = [&](const Settings& settings) {
        const numerics::Frame frame(context(), registry, scene,
                                    registry.findTechnique("screen_space_photons"),
                                    {100, 75, settings, {"media.in_scattered"}});
        const Texels texels = frame.read("media.in_scattered");
        dvec3 sum(0.0);
        for (int y = 0; y < texels.height; ++y) {
            for (int x = 0; x < texels.width; ++x)
                sum += texels.rgb(x, y);
        }
        return std::pair(sum.g, frame.renderer().ledger().balance());
    };
    const auto [dense, balanceOfDense] = scattered({{"emit.photons", "128x128"}});
    for (const char* medium : {"0", "2"}) {
        const auto [sum, balance] = scattered({{"driver", "adaptive"},
                                               {"emit", "deferred"},
                                               {"refine.finest", "128"},
                                               {"refine.start", "16"},
                                               {"refine.check", "64"},
                                               {"refine.medium", medium}});
        EXPECT_NEAR(sum, dense, 0.03 * dense) << medium;
        EXPECT_LE(std::abs(balance), 1e-6);
    }
}

TEST(AdaptivePhotons, SayWhatTheyCannotDo) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const auto messageOf = [&](const Settings& settings) -> std::string {
        try {
            adaptive(scene, settings);
        } catch (const ConfigError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(messageOf({{"refine.finest", "1000"}}).find("512 and 1024 are"), std::string::npos);
    EXPECT_NE(messageOf({{"emit", "grid"}}).find("take emit=deferred"), std::string::npos);
    EXPECT_NE(messageOf({{"filter", "level_sum"}}).find("reconstruct=multi_level"),
              std::string::npos);
}

TEST(AdaptivePhotons, SayWhichSettingsOtherDriversDoNotRead) {
    const scene::Scene scene = ballScene(lamp("lamp", {0.5, 3.0, 0.3}));
    const auto named = [&](const std::string& driver) {
        const MapFrame frame = gridded(scene, "caustic_map",
                                       {{"driver", driver},
                                        {"refine.tolerance", "2"},
                                        {"refine.metric", "eye"},
                                        {"refine.finest", "512"}});
        std::set<std::string> names;
        for (const std::string& warning : frame.renderer().warnings()) {
            if (warning.find(" has no effect with driver=" + driver) != std::string::npos)
                names.insert(warning.substr(0, warning.find(' ')));
        }
        return names;
    };
    EXPECT_EQ(named("dense"),
              (std::set<std::string>{"refine.finest", "refine.metric", "refine.tolerance"}));
    EXPECT_EQ(named("hierarchical"), (std::set<std::string>{"refine.finest"}));
}

}  // namespace
}  // namespace kaustik::test
