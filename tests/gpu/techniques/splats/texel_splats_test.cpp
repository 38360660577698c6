// SPDX-License-Identifier: MIT
// Splats of a light's map (WD06; WD08, sections 4 and 4.1): what they keep, against conservation
// and linearity, and what filters make of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/numerics/stage_harness.h"
#include "framework/report/map_account.h"
#include "tests/gpu/techniques/sheet_light.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec2;
using glm::dvec3;

TEST(BlurredPoints, AreSplatsByLinearity) {
    // A floor that is smaller than what the water lights, so that light lies at the map's border.
    const scene::Scene scene =
        makeScene(kAbove, sun({0.2, -1.0, 0.1}) + rippledWater() + floorOf(1.0));
    for (const auto& [blur, diameter] : {std::pair{"7", "7"}, {"3", "3"}, {"15", "15"}}) {
        SCOPED_TRACE(blur);
        const MapFrame splats(scene, "caustic_map",
                              with(kSmall, {{"reconstruct.fixed.diameter", diameter},
                                            {"reconstruct.fixed.center", "texel"},
                                            {"reconstruct.fixed.edges", "crossed"}}));
        const MapFrame points(scene, "caustic_map",
                              with(kSmall, {{"reconstruct.fixed.diameter", "1"},
                                            // Also of a texel whose middle sees past the floor.
                                            {"reconstruct.fixed.edges", "crossed"},
                                            {"filter", "blur"},
                                            {"filter.blur.diameter", blur}}));
        const MapTexels drawn = storedIn(splats);
        const MapTexels blurred = points.filtered();
        // As far from the border as no splat that it clips, of which a blur keeps the rest,
        // reaches.
        EXPECT_GT(brightest(drawn), 0.0);
        EXPECT_LT(largestDifferenceWithin(drawn, blurred, std::stoi(diameter)),
                  kFlux * brightest(drawn));
        // It is a blur.
        EXPECT_GT(largestDifference(drawn, storedIn(points)), 0.01 * brightest(drawn));
        splats.expectBalance();
        points.expectBalance();
    }
}

TEST(ABlurOfAnEvenDiameter, IsThatOfOneLess) {
    const scene::Scene scene = waves();
    const auto blurred = [&](const char* diameter) {
        const Settings points{{"reconstruct.fixed.diameter", "1"},
                              {"filter", "blur"},
                              {"filter.blur.diameter", diameter}};
        return MapFrame(scene, "caustic_map", with(kSmall, points)).filtered();
    };
    EXPECT_EQ(largestDifference(blurred("8"), blurred("7")), 0.0);
}

class MadeUpPhotons : public ::testing::Test {
  protected:
    // On the floor, of 1 W, where the map of the light has these texels.
    numerics::Frame store(const scene::Scene& scene, const render::RasterView& view,
                          const std::vector<dvec2>& texels, double depth,
                          const Settings& settings) {
        return reconstruct(scene, photonsAt(view, texels, depth), settings);
    }
    static std::vector<StagePhoton> photonsAt(const render::RasterView& view,
                                              const std::vector<dvec2>& texels, double depth) {
        std::vector<StagePhoton> photons;
        for (const dvec2& texel : texels) {
            StagePhoton photon;
            photon.position = placeBefore(view, texel, depth);
            photon.direction = {0, -1, 0};
            photon.startNormal = {0, 1, 0};
            photon.startMaterial = kGrey;
            photons.push_back(photon);
        }
        return photons;
    }
    [[nodiscard]] Lab& lab() { return lab_; }
    numerics::Frame reconstruct(const scene::Scene& scene, const std::vector<StagePhoton>& photons,
                                const Settings& settings) {
        return reconstructHits(lab_, lab_.choose(ReconstructStage::name, "fixed"), scene, photons,
                               with({{"reconstruct.space", "light"},
                                     {"gather", "project"},
                                     {"filter", "none"},
                                     {"reconstruct.map_size", "128"},
                                     {"reconstruct.map_covers", "scene"}},
                                    settings));
    }

    // A floor that fills the map, but for its own border.
    const scene::Scene floor_ = makeScene(kAbove, sun({0, -1, 0}) + floorOf(4.0));
    [[nodiscard]] double depthOfFloor(const render::RasterView& view) const {
        return -glm::dvec3(view.worldToView * glm::dvec4(0, -1, 0, 1)).z;
    }

  private:
    Registry registry_ = registerAll();
    Suite suite_;
    Lab lab_{context(), registry_, suite_};
};

TEST_F(MadeUpPhotons, AreWholeSplatsAtEveryOffsetWithinATexel) {
    const render::RasterView view = mapViewOf(reconstruct(floor_, {}, {}));
    constexpr int kSteps = 8;
    constexpr int kApart = 15;
    for (const int diameter : {1, 2, 3, 7, 14}) {
        for (const char* center : {"photon", "texel"}) {
            SCOPED_TRACE(fmt::format("{} {}", diameter, center));
            std::vector<dvec2> texels;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                // From one edge of a texel to the other, but not on them.
                const dvec2 offset((i % kSteps + 0.01) / kSteps, (i / kSteps + 0.01) / kSteps);
                texels.push_back(dvec2(i % kSteps, i / kSteps) * double(kApart) + 10.0 + offset);
            }
            const numerics::Frame frame =
                store(floor_, view, texels, depthOfFloor(view),
                      {{"reconstruct.fixed.diameter", std::to_string(diameter)},
                       {"reconstruct.fixed.center", center}});
            const MapTexels map = storedIn(frame);
            double worstFlux = 0.0;
            double worstPlace = 0.0;
            for (const dvec2& texel : texels) {
                const glm::ivec2 own(glm::floor(texel));
                double sum = 0.0;
                dvec2 moment(0.0);
                for (int y = own.y - 7; y <= own.y + 7; ++y) {
                    for (int x = own.x - 7; x <= own.x + 7; ++x) {
                        sum += map.at(x, y).g;
                        moment += map.at(x, y).g * (dvec2(x, y) + 0.5);
                    }
                }
                worstFlux = std::max(worstFlux, std::abs(sum - 1.0));
                const bool isAtPhoton = std::string(center) == "photon" && diameter > 1;
                const dvec2 middle = isAtPhoton ? texel : dvec2(own) + 0.5;
                worstPlace = std::max(worstPlace, glm::distance(moment / sum, middle));
            }
            EXPECT_LT(worstFlux, kFlux);
            // A Gaussian that is cut at three deviations, by texels that it covers the middle of;
            // one of a texel or two is a square that jumps.
            EXPECT_LT(worstPlace, diameter >= 7 ? 0.07 : diameter == 3 ? 0.25 : 0.71);
        }
    }
}

TEST_F(MadeUpPhotons, AreInTheMapOrCountedBesideItAtItsBorder) {
    const render::RasterView view = mapViewOf(reconstruct(floor_, {}, {}));
    std::vector<dvec2> texels;
    for (int i = 0; i < 40; ++i) {
        const double near = 0.25 + 0.1 * i;
        for (const dvec2& texel : {dvec2(near, 3.0 * i + 1.3), dvec2(3.0 * i + 1.3, near),
                                   dvec2(128.0 - near, 3.0 * i + 1.7), dvec2(near, near)})
            texels.push_back(texel);
    }
    for (const char* diameter : {"1", "7", "63"}) {
        const numerics::Frame frame = store(floor_, view, texels, depthOfFloor(view),
                                            {{"reconstruct.fixed.diameter", diameter}});
        const double outside = frame.renderer().ledger().watts[transport::kAccountOutsideMap];
        EXPECT_NEAR(storedIn(frame).sum().g + outside, double(texels.size()),
                    kFlux * double(texels.size()))
            << diameter;
        // Points lie on one texel, and nothing of them next to the map.
        EXPECT_EQ(outside > 0.0, std::string(diameter) != "1") << diameter;
    }
}

TEST_F(MadeUpPhotons, BesideTheMapAndBehindWhatItSeesAreInTheLedger) {
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) + floorOf(4.0) + floorPlane("table", "white", 1.0, {0, -0.5, 0}));
    const auto landing = [](const dvec3& position, const dvec3& direction = {0, -1, 0}) {
        StagePhoton photon;
        photon.position = position;
        photon.direction = direction;
        photon.startNormal = {0, 1, 0};
        photon.startMaterial = kGrey;
        return photon;
    };
    std::vector<StagePhoton> photons(1, landing({1.2, -1.0, 0.3}));  // seen
    photons.insert(photons.end(), 2, landing({0.1, -1.0, 0.1}));     // below the table
    photons.insert(photons.end(), 4, landing({3.0, -1.0, 0.1}));     // next to the map
    // From below: the side that the light does not see.
    photons.insert(photons.end(), 8, landing({1.2, -1.0, 0.3}, {0, 1, 0}));
    const EnergyLedger ledger = reconstruct(scene, photons, {}).renderer().ledger();
    EXPECT_NEAR(ledger.watts[kAccountDeposited], 1.0, kFlux);
    EXPECT_NEAR(ledger.watts[kAccountHiddenInMap], 10.0, kFlux);
    EXPECT_NEAR(ledger.watts[kAccountOutsideMap], 4.0, kFlux);
}

// A table whose edge the splats reach over.
TEST_F(MadeUpPhotons, StayOnTheirSurfaceWhereEdgesAreKept) {
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) + floorOf(4.0) + floorPlane("table", "white", 1.0, {0, -0.5, 0}));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 50; ++i) {
        StagePhoton photon;
        photon.position = {0.5 - 0.003 * (i + 0.5), -0.5, 0.4 * std::sin(7.0 * i)};
        photon.direction = {0, -1, 0};
        photon.startNormal = {0, 1, 0};
        photon.startMaterial = kWhite;
        photons.push_back(photon);
    }
    for (const char* edges : {"kept", "crossed"}) {
        const numerics::Frame frame =
            reconstruct(scene, photons, {{"reconstruct.fixed.edges", edges}});
        const MapTexels map = storedIn(frame);
        const Texels seen = frame.read("light.receiver");
        const render::RasterView& view = mapViewOf(frame);
        double onTable = 0.0;
        double onFloor = 0.0;
        for (int y = 0; y < map.height; ++y) {
            for (int x = 0; x < map.width; ++x) {
                const dvec3 place = placeBefore(view, {x + 0.5, y + 0.5}, seen.at(x, y, 0));
                (std::abs(place.y + 0.5) < 1e-3 ? onTable : onFloor) += map.at(x, y).g;
            }
        }
        EXPECT_NEAR(onTable + onFloor, 50.0, kFlux * 50.0);
        if (std::string(edges) == "kept") {
            EXPECT_EQ(onFloor, 0.0);
        } else {
            EXPECT_GT(onFloor, 1.0);
        }
    }
}

// 2^18 photons of 0.1 W on a texel: a sum of floats is off by 2^18 halves of a last digit.
TEST_F(MadeUpPhotons, AddUpInATexelWithoutDrift) {
    const render::RasterView view = mapViewOf(reconstruct(floor_, {}, {}));
    constexpr std::size_t kPhotons = std::size_t{1} << 18U;
    StagePhoton photon;
    photon.position = placeBefore(view, {64.5, 64.5}, depthOfFloor(view));
    photon.direction = {0, -1, 0};
    photon.fluxWatts = dvec3(0.1);
    photon.startNormal = {0, 1, 0};
    photon.startMaterial = kGrey;
    const numerics::Frame frame = reconstruct(floor_, std::vector<StagePhoton>(kPhotons, photon),
                                              {{"reconstruct.fixed.diameter", "1"}});
    const double expected = double(kPhotons) * double{0.1f};
    EXPECT_NEAR(storedIn(frame).at(64, 64).g, expected, 1e-7 * expected);
}

// On the faces of a cube (U08, Fig. 9b): light falls straight down through a sheet that bends
// nothing, onto a floor that the reference point sees through the bottom face and the sides'.
TEST(PointsOnACube, AreTheTexelsThatPhotonsFallIntoAndNoOthers) {
    scene::Scene scene = makeScene({{0.0, 1.8, 2.5}, {0.0, 0.0, 0.0}},
                                   sun({0, -1, 0}) + floorPlane("floor", "grey", 12, {0, 0, 0}) +
                                       floorPlane("air", "water", 6, {0, 2, 0}));
    scene.materials[kWater - 1].ior = 1.0f;
    const Registry registry = registerAll();
    FrameRequest request{64,
                         48,
                         {{"reconstruct", "fixed"},
                          {"reconstruct.fixed.diameter", "1"},
                          {"emit.photons", "62x66"},
                          {"reconstruct.map_size", "256"}}};
    request.keepsAll = request.recordsTraces = true;
    const numerics::Frame frame(context(), registry, scene,
                                registry.findTechnique("caustic_triangles"), request);
    ASSERT_EQ(frame.renderer().outputs().map.maps.size(), 1u);
    const std::vector<HitTexel> hits =
        readHits(frame.renderer(), frame.renderer().traces().front().hits);
    std::size_t arrived = 0;
    std::size_t facesHit = 0;
    for (int face = 0; face < 6; ++face) {
        const render::RasterView& view = mapViewOf(frame, face);
        const MapTexels map = storedIn(frame, 0, face);
        std::vector<double> expected(map.flux.size(), 0.0);
        std::size_t here = 0;
        for (const HitTexel& hit : hits) {
            if (hit.fate != kFateReceiver) continue;
            const dvec3 world = frame.toWorld(dvec3(hit.position));
            if ((view.worldToView * glm::dvec4(world, 1.0)).z >= 0.0) continue;
            const dvec2 texel = glm::floor(texelOn(view, world));
            if (glm::any(glm::lessThan(texel, dvec2(0.0))) || texel.x >= map.width ||
                texel.y >= map.height)
                continue;
            expected[static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(map.width) +
                     static_cast<std::size_t>(texel.x)] += double{hit.fluxWatts.g};
            ++here;
        }
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            wrong += std::abs(map.flux[i].g - expected[i]) <= 1e-6 * expected[i] ? 0 : 1;
        // Of a photon on a border two texels, by rounding.
        EXPECT_LE(wrong, 2 * here / 1000) << face;
        arrived += here;
        facesHit += here > 0 ? 1 : 0;
    }
    EXPECT_EQ(arrived, 62u * 66u);
    EXPECT_EQ(facesHit, 5u);
}

class Uniform : public ::testing::TestWithParam<const char*> {};

TEST_P(Uniform, LightIsSoInAllSizesAndInTheirBlend) {
    const scene::Scene scene = uniform();
    // 2.4 photons a texel and axis: 52 on a splat of three texels, and more on the larger ones.
    const MapFrame frame(scene, "multi_resolution",
                         {{"emit.photons", "77x77"},
                          {"reconstruct.map_size", "64"},
                          {"reconstruct.map_covers", "scene"},
                          {"filter.blend.interpolant", GetParam()}});
    const double arrived = frame.watts(kAccountArrived);
    EXPECT_NEAR(arrived, 4000.0, 1e-3 * 4000.0);
    for (int set = 0; set < 4; ++set) {
        SCOPED_TRACE(set);
        const MapTexels map = storedIn(frame, set);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(map.sum()[channel], arrived, kFlux * arrived);
        const Field field = fieldOf(frame, map, 1000.0);
        EXPECT_GT(field.texels, 200);
        EXPECT_NEAR(field.mean, 1000.0, 5.0);
        // A Gaussian of half a texel's deviation ripples with the photons' grid.
        EXPECT_LT(field.worst, set == 0 ? 0.08 : 0.02);
        const double width = 3.0 + 4.0 * set;
        const double expected = std::pow(width * 77.0 / 2.0 * (4.0 / 64.0), 2.0);
        const std::vector<std::uint32_t> counts = frame.counts(set);
        const double counted = counts[32 * 64 + 32];
        // A row more or less.
        EXPECT_NEAR(std::sqrt(counted), std::sqrt(expected), 1.0);
    }
    // So many photons that the smallest size is enough everywhere.
    const Field field = fieldOf(frame, frame.filtered(), 1000.0);
    EXPECT_NEAR(field.mean, 1000.0, 5.0);
    EXPECT_LT(field.worst, 0.08);
    frame.expectBalance();
}

TEST_P(Uniform, LightOfFewPhotonsIsSoInTheBlendToo) {
    const scene::Scene scene = uniform();
    // 1.1 photons a texel and axis: of the smallest size 9 to 16, where sizes are blended.
    const MapFrame frame(scene, "multi_resolution",
                         {{"emit.photons", "35x35"},
                          {"reconstruct.map_size", "64"},
                          {"reconstruct.map_covers", "scene"},
                          {"filter.blend.interpolant", GetParam()}});
    const std::vector<std::uint32_t> counts = frame.counts(0);
    const std::uint32_t middle = counts[32 * 64 + 32];
    EXPECT_GT(middle, 8U);
    EXPECT_LT(middle, 17U);
    const Field field = fieldOf(frame, frame.filtered(), 1000.0);
    // Only brighter splats are joined, which takes from the mean of those of three texels less
    // than their ripple.
    EXPECT_NEAR(field.mean, 1000.0, 30.0);
    EXPECT_LT(field.worst, 0.2);
    double filtered = 0.0;
    for (const dvec3& flux : frame.filtered().flux)
        filtered += (flux.r + flux.g + flux.b) / 3.0;
    const auto account = report::mapAccount(frame.renderer());
    EXPECT_NEAR(account["blend_energy_ratio"].get<double>(),
                filtered / frame.watts(kAccountDeposited), 1e-6);
    EXPECT_NEAR(account["flux_ratio"].get<double>(), 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(By, Uniform, ::testing::Values("bernstein", "nested", "linear"),
                         [](const auto& tested) { return std::string(tested.param); });

class Blend : public ::testing::TestWithParam<const char*> {};

TEST_P(Blend, TakesTheSmallestSizeThatHasEnoughAndLiesBetweenSizes) {
    const scene::Scene scene = waves();
    const auto render = [&](const char* minimum, const char* maximum) {
        return MapFrame(scene, "multi_resolution",
                        with(kSmall, {{"filter.blend.interpolant", GetParam()},
                                      {"filter.blend.min_photons", minimum},
                                      {"filter.blend.max_photons", maximum}}));
    };
    // Of floats with 24 bits.
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(a, b); };
    const MapFrame all = render("0", "1");
    const MapFrame none = render("999999", "1000000");
    const MapFrame usual = render("8", "16");
    std::vector<MapTexels> sets;
    for (int i = 0; i < 4; ++i)
        sets.push_back(storedIn(usual, i));
    const std::vector<std::uint32_t> counts[4] = {usual.counts(0), usual.counts(1), usual.counts(2),
                                                  usual.counts(3)};
    const MapTexels smallest = all.filtered();
    const MapTexels largest = none.filtered();
    const MapTexels blended = usual.filtered();
    int whole = 0;
    int mixed = 0;
    for (std::size_t i = 0; i < blended.flux.size(); ++i) {
        const double value = blended.flux[i].g;
        if (counts[0][i] > 0) {
            ASSERT_TRUE(same(smallest.flux[i].g, sets[0].flux[i].g));
        }
        ASSERT_TRUE(same(largest.flux[i].g, sets[3].flux[i].g));
        double minimum = 1e30;
        double maximum = 0.0;
        for (const MapTexels& set : sets) {
            minimum = std::min(minimum, set.flux[i].g);
            maximum = std::max(maximum, set.flux[i].g);
        }
        ASSERT_GE(value, minimum * (1.0 - 1e-6));
        ASSERT_LE(value, maximum * (1.0 + 1e-6));
        if (counts[0][i] >= 16) {
            ++whole;
            ASSERT_TRUE(same(value, sets[0].flux[i].g));
            continue;
        }
        // Sizes with eight photons or fewer have no part in it.
        int enough = 0;
        while (enough < 3 && counts[enough][i] < 16)
            ++enough;
        if (counts[enough - 1][i] <= 8) {
            ASSERT_TRUE(same(value, sets[static_cast<std::size_t>(enough)].flux[i].g));
        } else if (std::string(GetParam()) != "linear") {
            // Never darker than the size that has enough.
            ASSERT_GE(value, sets[static_cast<std::size_t>(enough)].flux[i].g * (1.0 - 1e-6));
            ++mixed;
        } else {
            const double t = (counts[enough - 1][i] - 8.0) / 8.0;
            const auto k = static_cast<std::size_t>(enough);
            ASSERT_TRUE(same(value, t * sets[k - 1].flux[i].g + (1.0 - t) * sets[k].flux[i].g));
            ++mixed;
        }
    }
    EXPECT_GT(whole, 100);
    EXPECT_GT(mixed, 100);
}

INSTANTIATE_TEST_SUITE_P(By, Blend, ::testing::Values("bernstein", "nested", "linear"),
                         [](const auto& tested) { return std::string(tested.param); });

// Photons in the middle of a texel, with others around it that larger splats reach alone: of the
// smallest size as many lie on the texel as are in its middle, of all others enough.
TEST_F(MadeUpPhotons, TakeOverFromLargerSplatsWithoutAJumpButInASumOfWeights) {
    const render::RasterView view = mapViewOf(reconstruct(floor_, {}, {}));
    const auto weightOf = [&](const char* interpolant, int photons) {
        std::vector<dvec2> texels(static_cast<std::size_t>(photons), dvec2(64.5, 64.5));
        for (int i = 0; i < 16; ++i) {
            const double angle = 2.0 * 3.14159265358979 * i / 16.0;
            texels.push_back(dvec2(64.5 + 2.6 * std::cos(angle), 64.5 + 2.6 * std::sin(angle)));
        }
        Lab& lab = this->lab();
        std::vector<StagePhoton> made = photonsAt(view, texels, depthOfFloor(view));
        const numerics::Frame frame =
            reconstructHits(lab, lab.choose(ReconstructStage::name, "four_radii"), floor_, made,
                            {{"reconstruct.space", "light"},
                             {"gather", "project"},
                             {"filter.blend.interpolant", interpolant},
                             {"reconstruct.map_size", "128"},
                             {"reconstruct.map_covers", "scene"}});
        const FluxMap& map = frame.renderer().outputs().map.maps.front();
        const double blended = frame.read(map.filtered).rgb(64, 64).g;
        const double smallest = storedIn(frame, 0).at(64, 64).g;
        const double next = storedIn(frame, 1).at(64, 64).g;
        EXPECT_GT(smallest, 1.5 * next);
        return (blended - next) / (smallest - next);
    };
    // B(t) = 3 t² (1 - t) + t³ at t = (n - 8)/8.
    const auto bernstein = [](int photons) {
        const double t = (photons - 8.0) / 8.0;
        return 3.0 * t * t * (1.0 - t) + t * t * t;
    };
    for (const int photons : {8, 9, 12, 15, 16}) {
        const double own = bernstein(photons);
        EXPECT_NEAR(weightOf("nested", photons), own, 1e-5) << photons;
        EXPECT_NEAR(weightOf("bernstein", photons), photons == 16 ? 1.0 : own / (1.0 + own), 1e-5)
            << photons;
    }
    EXPECT_NEAR(weightOf("bernstein", 15), 0.489, 1e-3);
    EXPECT_NEAR(weightOf("nested", 15), 0.957, 1e-3);
}

}  // namespace
}  // namespace kaustik::test
