// SPDX-License-Identifier: MIT
// emit.grid against closed forms: what a light sends through what it sees, to a part of a cell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "framework/core/error.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/scene/files/scene_file.h"
#include "framework/transport/watts.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

const CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};
constexpr double kIrradiance = 1000.0;  // what sun() sends, W/m² across its direction

double emittedWatts(const scene::Scene& scene, const std::string& photons, int subcells,
                    const std::string& sight = "raster") {
    const Frame frame(scene, 64, 48,
                      {{"emit.photons", photons},
                       {"emit.grid.subcells", std::to_string(subcells)},
                       {"emit.grid.sight", sight},
                       {"specular", "interface"}});
    EXPECT_LE(std::abs(frame.renderer().ledger().balance()), 1e-6);
    return frame.renderer().ledger().watts[kAccountEmitted];
}

// Still water, 1.9 m by 1.3 m, in the open.
scene::Scene sheet(const dvec3& direction, const std::string& rest = "") {
    return makeScene(kAbove, sun(direction) +
                                 object("water", "plane", "water", {0, 0, 0}, "size = [1.9, 1.3]") +
                                 floorPlane("floor", "grey", 8.0, {0, -1, 0}) + rest);
}

// Who finds what a light sees.
std::vector<std::string> sights() {
    if (lacksExactTracer()) return {"raster"};
    return {"raster", "processor"};
}

class GridEmission : public ::testing::TestWithParam<const char*> {};

TEST_P(GridEmission, IsWhatFallsOnASheetThatLiesAcrossTheGrid) {
    const dvec3 direction(0.5, -1.0, 0.4);
    const double cosine = 1.0 / glm::length(direction);
    const double expected = kIrradiance * wattsOf(glm::vec3(1.0f)) * 1.9 * 1.3 * cosine;
    // A border that is known to a part of a cell is off by a share of what a border by whole cells
    // may be: those that it passes, of all.
    const int cells = std::stoi(GetParam());
    const double perimeter = 2.0 * (1.9 + 1.3) / std::sqrt(1.9 * 1.3) / cells;
    for (const std::string& sight : sights()) {
        const auto share = [&](int subcells) {
            return emittedWatts(sheet(direction), GetParam(), subcells, sight) / expected;
        };
        EXPECT_NEAR(share(5), 1.0, 0.05 * perimeter) << sight;
        EXPECT_NEAR(share(1), 1.0, 0.5 * perimeter) << sight;
    }
}

// A board in front of the light: its shadow's border is no sheet's own.
TEST_P(GridEmission, IsWhatABoardLeavesOfIt) {
    const double height = 0.5;
    const dvec3 direction(0.2, -1.0, 0.0);
    const double edge = -0.13 + height * 0.2;  // of the board's shadow on the water, at greater x
    const scene::Scene scene =
        sheet(direction, object("board", "plane", "grey", {-3.13, height, 0}, "size = [6, 6]"));
    const double cosine = 1.0 / glm::length(direction);
    const double expected = kIrradiance * wattsOf(glm::vec3(1.0f)) * (0.95 - edge) * 1.3 * cosine;
    const int cells = std::stoi(GetParam());
    const double perimeter = 2.0 * (1.9 + 1.3) / std::sqrt(1.9 * 1.3) / cells;
    for (const std::string& sight : sights()) {
        EXPECT_NEAR(emittedWatts(scene, GetParam(), 5, sight) / expected, 1.0, 0.1 * perimeter)
            << sight;
    }
}

INSTANTIATE_TEST_SUITE_P(By, GridEmission, ::testing::Values("16x16", "47x47", "64x64", "128x128"),
                         [](const ::testing::TestParamInfo<const char*>& tested) {
                             return std::string("Photons") + tested.param;
                         });

// A lamp's cells are equal parts of a plane, not of what they light.
TEST(GridEmissionOfALamp, IsItsIntensityTimesTheSolidAngleOfTheSheet) {
    const double height = 1.2;
    const double a = 0.95;
    const double b = 0.65;
    const double solidAngle =
        4.0 * std::atan(a * b / (height * std::sqrt(a * a + b * b + height * height)));
    const scene::Scene scene =
        makeScene(kAbove,
                  "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, 1.2, 0]\n"
                  "intensity = 100\n" +
                      object("water", "plane", "water", {0, 0, 0}, "size = [1.9, 1.3]") +
                      floorPlane("floor", "grey", 8.0, {0, -1, 0}));
    const double expected = 100.0 * wattsOf(glm::vec3(1.0f)) * solidAngle;
    for (const std::string& sight : sights())
        EXPECT_NEAR(emittedWatts(scene, "64x64", 5, sight) / expected, 1.0, 2e-3) << sight;
}

// The light's border on the floor below still water, straight from above: lit cells end where the
// sheet does, whatever the grid is, and what is lit is as bright as the closed form has it.
TEST(GridEmissionBorder, LiesWhereTheSheetEnds) {
    const scene::Scene scene = makeScene(
        {{0.0, -0.2, 0.001}, {0.0, -1.0, 0.0}, 100.0, 0.01},
        sun({0.0, -1.0, 0.0}) +
            object("water", "plane", "water", {0, 0, 0}, "size = [0.97, 0.83]") +
            // The grid holds all that is specular: another sheet makes it wider than this one.
            object("far", "plane", "water", {1.4, 0.02, 0.9}, "size = [0.3, 0.3]") +
            floorPlane("floor", "grey", 8.0, {0, -1, 0}));
    const auto rowOf = [&](const std::string& sight) {
        const Frame frame(scene, 240, 180,
                          {{"emit.photons", "24x24"},
                           {"specular", "interface"},
                           {"emit.grid.sight", sight},
                           {"emit.grid.subcells", "5"}});
        return frame.causticIrradiance();
    };
    // Along x at z = 0 the lit part is 0.97 m wide; by whole cells of 0.08 m it cannot be.
    const auto widthOf = [](const Texels& irradiance) {
        double sum = 0.0;
        double maximum = 0.0;
        for (int x = 0; x < 240; ++x) {
            sum += irradiance.rgb(x, 90).g;
            maximum = std::max(maximum, double{irradiance.rgb(120, 90).g});
        }
        return sum / maximum;
    };
    const double pixelsPerMeter = 90.0 / (0.8 * std::tan(glm::radians(50.0)));
    for (const std::string& sight : sights())
        EXPECT_NEAR(widthOf(rowOf(sight)) / (0.97 * pixelsPerMeter), 1.0, 0.02) << sight;
}

// Rays and the rasteriser see the same but for triangles' edges, whose vertices the latter moves by
// up to 1/256 of a part of a cell: lamp and sun, a ball, and the shadow of a thin board.
TEST(GridSight, IsTheSameDrawnAndTraced) {
    if (lacksExactTracer()) {  // built without Embree
        EXPECT_THROW(emittedWatts(sheet({0, -1, 0}), "16x16", 5, "processor"), Error);
        return;
    }
    const std::string things =
        object("ball", "sphere", "glass", {0, 0.5, 0}, "radius = 0.4\nsegments = 48") +
        object("board", "plane", "grey", {0.1, 1.5, 0.1}, "size = [0.07, 2.0]") +
        floorPlane("floor", "grey", 8.0, {0, -1, 0});
    const std::string lamp =
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0.3, 2.2, 0]\nintensity = 100\n";
    for (const std::string& light : {sun({0.2, -1.0, 0.1}), lamp}) {
        const scene::Scene scene = makeScene(kAbove, light + things);
        // Photons of whole cells, and what is seen of cells at borders; in one band and in several
        // batches.
        for (const char* batch : {"4096", "600"}) {
            const auto fluxes = [&](const std::string& sight) {
                const Frame frame(
                    scene, 64, 48,
                    {{"emit.photons", "48x48"}, {"emit.batch", batch}, {"emit.grid.sight", sight}},
                    {"photons.flux"}, false, "exact_rays");
                return std::pair(
                    frame.renderer().texture(frame.renderer().graph().find("photons.flux")).read(),
                    frame.renderer().ledger().watts[kAccountEmitted]);
            };
            const auto [drawn, drawnWatts] = fluxes("raster");
            const auto [traced, tracedWatts] = fluxes("processor");
            EXPECT_NEAR(tracedWatts / drawnWatts, 1.0, 1e-3);
            ASSERT_EQ(drawn.size(), traced.size());
            double largest = 0.0;
            std::size_t others = 0;
            for (const float flux : drawn)
                largest = std::max(largest, static_cast<double>(flux));
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                const double difference =
                    std::abs(static_cast<double>(drawn[i]) - static_cast<double>(traced[i]));
                if (difference > 1e-4 * largest) ++others;
            }
            EXPECT_GT(largest, 0.0);
            EXPECT_LT(others, drawn.size() / 100) << light << " " << batch;
        }
    }
}

// Nobody keeps the photons and memory starts as NaN: of a cell without one no more is stored than
// that there is none. Photons that are kept are cleared.
TEST(EmittedPhotons, OfACellWithoutAPhotonNobodyReadsMoreThanThat) {
    for (const char* name : {"pool", "cornell-bunny"}) {
        const scene::Scene scene = scene::loadScene(name);
        for (const char* technique :
             {"exact_rays", "screen_space_photons", "caustic_map", "caustic_triangles",
              "multi_resolution", "lens_splats", "eye_gather", "planar"}) {
            const auto render = [&](const std::string& sight,
                                    const std::vector<std::string>& kept) {
                return Frame(scene, 64, 48, {{"emit.photons", "48x48"}, {"emit.grid.sight", sight}},
                             kept, true, technique);
            };
            // What finds them is the same code for all.
            const bool isDefault = std::string(technique) == "exact_rays";
            for (const std::string& sight :
                 isDefault ? sights() : std::vector<std::string>{"auto"}) {
                const Frame cleared = render(sight, {"photons.position"});
                const Frame read = render(sight, {});
                for (const bool isCaustic : {true, false}) {
                    const auto outputOf = [&](const Frame& frame) {
                        const FrameOutputs& outputs = frame.renderer().outputs();
                        return isCaustic ? frame.read(outputs.caustic.irradiance)
                                         : frame.read(outputs.picture.radiance);
                    };
                    const Texels expected = outputOf(cleared);
                    EXPECT_GT(expected.sum(), 0.0) << name << ", " << technique;
                    EXPECT_EQ(outputOf(read).values, expected.values) << name << ", " << technique;
                }
                EXPECT_EQ(read.renderer().ledger().watts, cleared.renderer().ledger().watts)
                    << name << ", " << technique;
            }
        }
    }
}

}  // namespace
}  // namespace kaustik::test
