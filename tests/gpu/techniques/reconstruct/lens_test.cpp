// SPDX-License-Identifier: MIT
// What specular.two_interfaces makes of beams, by WD08's thin lens (section 4.2, Eqs. 1 to 7), by a
// thick one and by ray differentials: against the focal lengths of balls, lenses and water.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/techniques/caustic_map_frame.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

const CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, -0.5, 0.0}, 60.0, 0.01};

std::string lamp(double height) {
    return fmt::format(
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, {}, 0]\nintensity = 100\n",
        number(height));
}
std::string ball() {
    return object("ball", "sphere", "glass", {0, 0, 0}, "radius = 0.5\nsegments = 640");
}
// Both faces of a radius of 1 m: 1/f = 2 (n - 1) = 1/m, but for its thickness.
std::string lens() {
    return object("lens", "lens", "glass", {0, 0, 0},
                  "top_radius = 1\nbottom_radius = 1\ndiameter = 0.4\ncenter_thickness = "
                  "0.05\nsegments = 512");
}
std::string floorAt(double height) {
    return floorPlane("floor", "grey", 6.0, {0, height, 0});
}

MapFrame render(const scene::Scene& scene, const std::string& model, const Settings& more = {}) {
    Settings settings{{"emit.photons", "64x64"},
                      {"reconstruct.map_size", "256"},
                      {"reconstruct.map_covers", "scene"},
                      {"specular.two_interfaces.distance", "search"},
                      {"specular.two_interfaces.size", "512"},
                      {"specular.two_interfaces.lens", model}};
    settings.insert(settings.end(), more.begin(), more.end());
    return {scene, "lens_splats", settings, true};
}

double dot(const glm::dmat2& a, const glm::dmat2& b) {
    return glm::dot(a[0], b[0]) + glm::dot(a[1], b[1]);
}
// How far beyond where it is the photon's beam is smallest, m.
double toFocus(const MapPhoton& photon) {
    return -dot(photon.place, photon.turn) / dot(photon.turn, photon.turn);
}

// Photons that came in so near the axis, m.
std::vector<MapPhoton> paraxial(const MapFrame& frame, double maximum, double x = 0.0,
                                double z = 0.0) {
    std::vector<MapPhoton> near;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.fate == kFateInFlight &&
            std::hypot(photon.entry.x - x, photon.entry.z - z) < maximum)
            near.push_back(photon);
    }
    return near;
}

struct Model {
    const char* name;
    double ballsFocus;  // in radii from its middle
};
class Lens : public ::testing::TestWithParam<Model> {
  protected:
    const std::string model = GetParam().name;
};

TEST_P(Lens, HasABallsFocusWhereItsModelHasIt) {
    const scene::Scene scene = makeScene(kAbove, sun({0, -1, 0}) + ball() + floorAt(-2.0));
    const std::vector<MapPhoton> photons = paraxial(render(scene, model), 0.05);
    ASSERT_GT(photons.size(), 20U);
    for (const MapPhoton& photon : photons) {
        const double focus = -photon.position.y + toFocus(photon);
        // A tenth of a radius off the axis the focus is 0.5 % nearer; what curves is known from
        // neighbouring pixels.
        EXPECT_NEAR(focus, 0.5 * GetParam().ballsFocus, 0.5 * 0.02);
    }
}

TEST_P(Lens, SendsOnWhatComesFromItsFocalLengthAsAParallelBeam) {
    // From its middle, for a lens of this thickness a principal plane's 1 % nearer.
    const scene::Scene scene = makeScene(kAbove, lamp(1.0) + lens() + floorAt(-2.0));
    const MapFrame frame = render(scene, model);
    const std::vector<MapPhoton> photons = paraxial(frame, 0.05);
    ASSERT_GT(photons.size(), 20U);
    for (const MapPhoton& photon : photons) {
        EXPECT_TRUE(std::isfinite(photon.widthAfter(0.0)));
        EXPECT_GT(photon.widthAfter(0.0), 0.0);
        EXPECT_NEAR(photon.widthAfter(2.0) / photon.widthAfter(0.0), 1.0, 0.08);
    }
    frame.expectBalance();
    EXPECT_GT(frame.watts(kAccountDeposited), 0.99 * frame.watts(kAccountArrived));
}

TEST_P(Lens, KeepsAllFluxOnAReceiverBeforeAtAndPastItsFocus) {
    for (const double distance : {0.5, 1.0, 2.0}) {
        SCOPED_TRACE(distance);
        const scene::Scene scene = makeScene(kAbove, sun({0, -1, 0}) + lens() + floorAt(-distance));
        const MapFrame frame = render(scene, model);
        for (const MapPhoton& photon : paraxial(frame, 0.08)) {
            // Eq. 7 with the absolute value: D0 |1 - d/f|, of a cell.
            const double cell = 0.4 / 64.0;
            EXPECT_NEAR(photon.widthAfter(photon.position.y + distance),
                        cell * std::abs(1.0 - distance), 0.03 * cell);
        }
        frame.expectBalance();
        const double arrived = frame.watts(kAccountArrived);
        EXPECT_GT(arrived, 100.0);
        EXPECT_NEAR(frame.watts(kAccountDeposited), arrived, 1e-5 * arrived);
        for (const float value : frame.causticIrradiance().values)
            ASSERT_TRUE(std::isfinite(value));
    }
}

TEST_P(Lens, OfAWavesCrestFocusesBelowItInClosedForm) {
    const double amplitude = 0.01;
    const double wavelength = 0.5;
    const double k = 2.0 * std::numbers::pi / wavelength;
    const double focal = kWaterIndex / ((kWaterIndex - 1.0) * amplitude * k * k);
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) +
                    object("water", "water", "water", {0, 0, 0},
                           "size = [1, 1]\ncells = [400, 400]\nwaves = ["
                           "{amplitude = 0.01, wavelength = 0.5, direction_degrees = 0, omega = 0},"
                           "{amplitude = 0.01, wavelength = 0.5, direction_degrees = 90, "
                           "omega = 0}]") +
                    floorAt(-2.0));
    const std::vector<MapPhoton> photons = paraxial(render(scene, model), 0.03);
    ASSERT_GT(photons.size(), 5U);
    for (const MapPhoton& photon : photons) {
        // 0.03 m next to the crest the curvature is less by 1 - cos(0.03 k) = 7 %; the mean of both
        // directions by half of that.
        const double here = 0.5 * (std::cos(k * photon.entry.x) + std::cos(k * photon.entry.z));
        EXPECT_NEAR(toFocus(photon), focal / here, 0.04 * focal);
    }
}

TEST_P(Lens, IsThatOfRayDifferentialsNearTheAxis) {
    const scene::Scene scene = makeScene(kAbove, sun({0, -1, 0}) + lens() + floorAt(-2.0));
    const std::vector<MapPhoton> own = paraxial(render(scene, model), 0.05);
    const std::vector<MapPhoton> beams = paraxial(render(scene, "beam"), 0.05);
    ASSERT_EQ(own.size(), beams.size());
    ASSERT_GT(own.size(), 20U);
    for (std::size_t i = 0; i < own.size(); ++i) {
        ASSERT_EQ(own[i].cell, beams[i].cell);
        // A thin lens is off by its thickness in focal lengths, 5 %, half of it each way.
        for (const double distance : {0.0, 0.5, 1.5})
            EXPECT_NEAR(own[i].widthAfter(distance), beams[i].widthAfter(distance),
                        0.03 * 0.4 / 64.0);
    }
}

INSTANTIATE_TEST_SUITE_P(By, Lens,
                         ::testing::Values(Model{"thin", 1.0}, Model{"thick", 1.5},
                                           Model{"beam", 1.5}),
                         [](const auto& tested) { return std::string(tested.param.name); });

// A convex mirror spreads parallel light as if it came from half a radius behind it.
TEST_P(Lens, OfAMirrorHasItsFocusHalfARadiusBehindIt) {
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) +
                    object("ball", "sphere", "mirror", {0, 0, 0}, "radius = 0.5\nsegments = 640") +
                    floorAt(-2.0));
    const std::vector<MapPhoton> photons = paraxial(render(scene, model), 0.05);
    ASSERT_GT(photons.size(), 20U);
    for (const MapPhoton& photon : photons) {
        EXPECT_TRUE(photon.isReflected);
        // A tenth of a radius off the axis it is 1 % nearer in one direction.
        EXPECT_NEAR(toFocus(photon), -0.25, 0.25 * 0.02);
    }
}

// The ball in front of a lamp at its focal length, 1.5 radii from its middle.
TEST(AThickLens, MakesABallsFocalLengthParallel) {
    const scene::Scene scene = makeScene(kAbove, lamp(0.75) + ball() + floorAt(-2.0));
    for (const char* model : {"thick", "beam"}) {
        const std::vector<MapPhoton> photons = paraxial(render(scene, model), 0.04);
        ASSERT_GT(photons.size(), 10U);
        for (const MapPhoton& photon : photons)
            EXPECT_NEAR(photon.widthAfter(1.0) / photon.widthAfter(0.0), 1.0, 0.06) << model;
    }
}

// A wall that light grazes and the eye sees face on, as at a pool's: light of one direction,
// through a sheet of index 1. Of the irradiance of the closed form nothing may be missing between
// splats.
double rippleOnAWall(const char* shape, double* meanShare = nullptr) {
    const scene::Scene scene = makeScene(
        {{0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, 40.0, 0.01},
        sun({0.0, -1.0, -0.2}) + "[[material]]\nname = \"air\"\ntype = \"dielectric\"\nior = 1\n" +
            object("sheet", "plane", "air", {0, 1.5, 0}, "size = [4, 3]\ncells = [8, 8]") +
            facingPlane("wall", "grey", 1.6, {0, 0, -0.5}));
    const Frame frame(scene, 100, 75,
                      {{"emit.photons", "128x128"},
                       {"specular", "interface"},
                       {"trace", "plane"},
                       {"reconstruct.lens.shape", shape}},
                      {}, false, "eye_gather");
    const double sine = 0.2 / std::sqrt(1.04);
    const double expected = 1000.0 * sine;
    const Texels irradiance = frame.causticIrradiance();
    double worst = 0.0;
    double mean = 0.0;
    int pixels = 0;
    for (int y = 25; y < 50; ++y) {
        for (int x = 35; x < 65; ++x) {
            const double share = irradiance.rgb(x, y).g / expected;
            worst = std::max(worst, std::abs(share - 1.0));
            mean += share;
            ++pixels;
        }
    }
    if (meanShare != nullptr) *meanShare = mean / pixels;
    EXPECT_LT(std::abs(frame.renderer().ledger().balance()), 1e-6);
    return worst;
}

TEST(LensSplats, LeaveNoHolesOnAWallThatLightGrazes) {
    double mean = 0.0;
    const double worst = rippleOnAWall("receiver", &mean);
    EXPECT_NEAR(mean, 1.0, 0.02);
    // A Gaussian of 3.5 beams that ends at three deviations ripples by
    // 2 exp(-2 (pi 3.5 / 6)²) = 0.2 % along each axis of a square grid; texels take its middle.
    EXPECT_LT(worst, 0.05);
    // As published they are five times as far apart as they are wide along the wall.
    EXPECT_GT(rippleOnAWall("texels"), 0.3);
}

}  // namespace
}  // namespace kaustik::test
