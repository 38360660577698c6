// SPDX-License-Identifier: MIT
// emit.grid against closed forms: what a light sends through what it sees, to a part of a cell.
#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "framework/numerics/cases/scene_text.h"
#include "framework/transport/watts.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

const CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};
constexpr double kIrradiance = 1000.0;  // what sun() sends, W/m² across its direction

double emittedWatts(const scene::Scene& scene, const std::string& photons, int subcells) {
    const Frame frame(scene, 64, 48,
                      {{"emit.photons", photons},
                       {"emit.grid.subcells", std::to_string(subcells)},
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

class GridEmission : public ::testing::TestWithParam<const char*> {};

TEST_P(GridEmission, IsWhatFallsOnASheetThatLiesAcrossTheGrid) {
    const dvec3 direction(0.5, -1.0, 0.4);
    const double cosine = 1.0 / glm::length(direction);
    const double expected = kIrradiance * wattsOf(glm::vec3(1.0f)) * 1.9 * 1.3 * cosine;
    // A border that is known to a part of a cell is off by a share of what a border by whole cells
    // may be: those that it passes, of all.
    const int cells = std::stoi(GetParam());
    const double perimeter = 2.0 * (1.9 + 1.3) / std::sqrt(1.9 * 1.3) / cells;
    EXPECT_NEAR(emittedWatts(sheet(direction), GetParam(), 5) / expected, 1.0, 0.05 * perimeter);
    EXPECT_NEAR(emittedWatts(sheet(direction), GetParam(), 1) / expected, 1.0, 0.5 * perimeter);
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
    EXPECT_NEAR(emittedWatts(scene, GetParam(), 5) / expected, 1.0, 0.1 * perimeter);
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
    EXPECT_NEAR(emittedWatts(scene, "64x64", 5) / expected, 1.0, 2e-3);
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
    const auto rowOf = [&](int subcells) {
        const Frame frame(scene, 240, 180,
                          {{"emit.photons", "24x24"},
                           {"specular", "interface"},
                           {"emit.grid.subcells", std::to_string(subcells)}});
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
    EXPECT_NEAR(widthOf(rowOf(5)) / (0.97 * pixelsPerMeter), 1.0, 0.02);
}

}  // namespace
}  // namespace kaustik::test
