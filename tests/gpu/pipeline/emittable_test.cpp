// SPDX-License-Identifier: MIT
// What lights send onto the specular surfaces that they see (kAccountEmittable), against closed
// forms: whatever is emitted of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;

const CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};
const std::string kFloor = floorPlane("floor", "grey", 12, {0, -1, 0});

std::string lamp(double height) {
    return fmt::format(
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, {}, 0]\nintensity = 50\n",
        number(height));
}
std::string pane(double width, double depth) {
    return object("pane", "plane", "water", {0, 0, 0},
                  fmt::format("size = [{}, {}]", number(width), number(depth)));
}

EnergyLedger ledgerOf(const scene::Scene& scene, const Settings& settings) {
    return Frame(scene, 64, 48, settings).renderer().ledger();
}

// A rectangle whose middle is straight below, sr.
double solidAngle(double width, double depth, double height) {
    const double a = 0.5 * width;
    const double b = 0.5 * depth;
    return 4.0 *
           std::asin(a * b / std::sqrt((a * a + height * height) * (b * b + height * height)));
}

// Of a rectangle that fills the light's view no border is off: what is left are 32-bit roundings.
TEST(EmittableLight, OfTheSunIsIrradianceTimesTheAreaAcrossIt) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.0, -1.0, 0.4));
    const double expected = 800.0 * 1.9 * 1.3 * -direction.y;
    for (const char* photons : {"2x2", "7x7", "64x64"}) {
        const EnergyLedger ledger =
            ledgerOf(makeScene(kAbove, sun(direction, 800.0) + pane(1.9, 1.3) + kFloor),
                     {{"emit.photons", photons}});
        // A row of texels of 1,024, at most.
        EXPECT_NEAR(ledger.watts[kAccountEmittable], expected, 1e-3 * expected) << photons;
        EXPECT_LT(std::abs(ledger.balance()), 1e-6);
    }
}

TEST(EmittableLight, OfALampIsIntensityTimesTheSolidAngle) {
    const double expected = 50.0 * solidAngle(1.9, 1.3, 2.0);
    const EnergyLedger ledger =
        ledgerOf(makeScene(kAbove, lamp(2.0) + pane(1.9, 1.3) + kFloor), {{"emit.photons", "8x8"}});
    EXPECT_NEAR(ledger.watts[kAccountEmittable], expected, 1e-3 * expected);
}

// Wider than 160 degrees: the emitters' views end there, and this one does not.
TEST(EmittableLight, OfALampCloseToASheetIsAllOfIt) {
    const double expected = 50.0 * solidAngle(2.0, 2.0, 0.05);
    const EnergyLedger ledger = ledgerOf(makeScene(kAbove, lamp(0.05) + pane(2.0, 2.0) + kFloor),
                                         {{"emit.photons", "64x64"}});
    // Of four faces half, to a texel of their 256 rows, and one whole.
    EXPECT_NEAR(ledger.watts[kAccountEmittable], expected, 5e-3 * expected);
    EXPECT_LT(ledger.watts[kAccountEmitted], 0.97 * expected);
}

// A board hides half of the pane from the sun.
TEST(EmittableLight, IsNoneWhereSomethingIsInTheWay) {
    const scene::Scene scene =
        makeScene(kAbove, sun({0, -1, 0}) + pane(2.0, 2.0) + kFloor +
                              object("board", "plane", "grey", {-1, 0.5, 0}, "size = [2, 4]"));
    const EnergyLedger ledger = ledgerOf(scene, {{"emit.photons", "8x8"}});
    EXPECT_NEAR(ledger.watts[kAccountEmittable], 2000.0, 2.0);
}

// Nine cells that are lit all or not at all, over a disc.
TEST(EmittableLight, JudgesAnEmissionThatMissesAPartOfIt) {
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) + kFloor +
                    object("ball", "sphere", "mirror", {0, 0.6, 0}, "radius = 0.5\nsegments = 64"));
    const double expected = 1000.0 * glm::pi<double>() * 0.25;
    EnergyLedger coarse = ledgerOf(scene, {{"emit.photons", "3x3"}, {"emit.grid.subcells", "1"}});
    EXPECT_NEAR(coarse.watts[kAccountEmittable], expected, 3e-3 * expected);
    const double emitted = coarse.watts[kAccountEmitted];
    EXPECT_GT(std::abs(emitted - expected), 0.05 * expected);
    const double balance = coarse.balance();
    coarse.judgeEmission(coarse.watts[kAccountEmittable]);
    EXPECT_EQ(coarse.watts[kAccountEmitted], coarse.watts[kAccountEmittable]);
    EXPECT_NEAR(coarse.watts[kAccountEmissionSampling], expected - emitted, 3e-3 * expected);
    // What was missed is a loss, and everything else as it was.
    EXPECT_NEAR(coarse.balance() * coarse.watts[kAccountEmitted], balance * emitted,
                1e-9 * expected);
}

TEST(EmittableLight, IsMeasuredForMeasurementsAlone) {
    const scene::Scene scene = makeScene(kAbove, sun({0, -1, 0}) + pane(2.0, 2.0) + kFloor);
    const Registry registry = registerAll();
    RenderSettings settings;
    settings.technique = registry.findTechnique("screen_space_photons");
    settings.params = registry.makeParams(settings.technique);
    settings.width = 32;
    settings.height = 24;
    Renderer renderer(context(), registry, scene, settings);
    const auto hasPass = [&](Purpose purpose) {
        renderer.build(purpose);
        const auto& steps = renderer.compiled().steps;
        return std::any_of(steps.begin(), steps.end(),
                           [](const auto& step) { return step.name == "ledger.emittable"; });
    };
    EXPECT_FALSE(hasPass(Purpose::picture));
    EXPECT_TRUE(hasPass(Purpose::measurement));
    EXPECT_TRUE(hasPass(Purpose::audit));
}

}  // namespace
}  // namespace kaustik::test
