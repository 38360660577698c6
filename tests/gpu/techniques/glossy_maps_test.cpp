// SPDX-License-Identifier: MIT
// What glossy receivers reflect of light that is stored in maps, by the directions that those hold,
// against the BRDF: of one direction exactly, whatever the sizes, levels, filters and spaces; of
// many on the whole. And what is said of directions that cannot be.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/numerics/stage_harness.h"
#include "framework/transport/brdf.h"
#include "techniques/maps/map_filters.h"
#include "tests/gpu/techniques/sheet_light.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using glm::dvec3;

constexpr double kExponent = 24.0;
const dvec3 kAlbedo(0.5, 0.25, 0.125);
const dvec3 kSpecular(0.25, 0.5, 0.125);
const std::string kPolished = fmt::format(
    "[[material]]\nname = \"polished\"\ntype = \"glossy\"\nalbedo = {}\nspecular = {}\n"
    "exponent = {}\n",
    numbers(kAlbedo), numbers(kSpecular), number(kExponent));

dvec3 brdf(const dvec3& toLight, const dvec3& toEye) {
    return transport::receiverBrdf(kAlbedo, kSpecular, kExponent, {0, 1, 0}, toLight, toEye);
}

// A sheet of index 1 over a polished floor that is larger, so that light ends within it.
const scene::Scene& oneDirection() {
    static const scene::Scene scene =
        makeScene({{0.3, 2.5, 2.6}, {0.0, -1.0, -0.4}, 50.0, 0.01},
                  sun({0.35, -1.0, -0.5}) + kPolished + sheet(1.0) +
                      object("floor", "plane", "polished", {0, -1, 0}, "size = [5, 5]"));
    return scene;
}

struct Stored {
    const char* name;
    Settings settings;
    friend void PrintTo(const Stored& stored, std::ostream* out) { *out << stored.name; }
};
const std::vector<Stored> kStored{
    {"fixed", {{"reconstruct", "fixed"}}},
    {"points_that_are_blurred",
     {{"reconstruct", "fixed"}, {"reconstruct.fixed.diameter", "1"}, {"filter", "blur"}}},
    {"four_radii", {{"reconstruct", "four_radii"}, {"filter", "blend"}}},
    {"four_radii_nested",
     {{"reconstruct", "four_radii"}, {"filter", "blend"}, {"filter.blend.interpolant", "nested"}}},
    {"levels", {{"reconstruct", "levels"}, {"filter", "levels"}}},
    {"levels_of_a_mip_chain",
     {{"reconstruct", "levels"}, {"filter", "levels"}, {"filter.levels.from", "mip"}}},
    {"multi_level", {{"reconstruct", "multi_level"}, {"filter", "level_sum"}}},
    {"lens", {{"reconstruct", "lens"}}},
    {"sprites", {{"reconstruct", "sprites"}}},
    {"beams", {{"reconstruct", "beams"}}},
    {"triangles", {{"reconstruct", "triangles"}}}};
const Settings kSpaces[]{{{"reconstruct.space", "screen"}, {"gather", "screen"}},
                         {{"reconstruct.space", "light"}, {"gather", "project"}},
                         {{"reconstruct.space", "cube"}, {"gather", "cube"}}};

class OneDirection : public testing::TestWithParam<Stored> {};

TEST_P(OneDirection, IsReflectedByTheBrdfAtEveryPixel) {
    const scene::Scene& scene = oneDirection();
    const dvec3 toLight = glm::normalize(dvec3(-0.35, 1.0, 0.5));
    for (const Settings& space : kSpaces) {
        SCOPED_TRACE(space.front().second);
        // Few photons, so that sizes and levels are really mixed.
        const Frame frame(scene, 96, 72,
                          with(with({{"emit.photons", "40x40"},
                                     {"reconstruct.map_size", "128"},
                                     {"around.cubes.size", "64"}},
                                    GetParam().settings),
                               space),
                          {"caustic.radiance"}, true);
        const Texels receiver = frame.read("eye.receiver");
        const Texels irradiance = frame.causticIrradiance();
        const Texels radiance = frame.read("caustic.radiance");
        double brightest = 0.0;
        for (const float value : irradiance.values)
            brightest = std::max(brightest, static_cast<double>(value));
        int pixels = 0;
        double worst = 0.0;
        for (int y = 0; y < 72; ++y) {
            for (int x = 0; x < 96; ++x) {
                const double own = irradiance.rgb(x, y).g;
                if (own < 1e-3 * brightest) continue;
                const dvec3 place = frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
                const dvec3 reflected =
                    brdf(toLight, glm::normalize(scene.camera.position - place));
                for (int c = 0; c < 3; ++c) {
                    const double expected = irradiance.rgb(x, y)[c] * reflected[c];
                    worst = std::max(worst, std::abs(radiance.rgb(x, y)[c] / expected - 1.0));
                }
                ++pixels;
            }
        }
        EXPECT_GT(pixels, 200);
        // Directions are floats that a map's whole units round: 1e-6 of them, times the exponent;
        // a mean that is so much shorter than 1 makes the lobe wider by as much times the exponent
        // again.
        EXPECT_LT(worst, 1e-3);
        EXPECT_LT(std::abs(frame.renderer().ledger().balance()), 1e-6);
        EXPECT_TRUE(frame.renderer().foundWarnings().empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Through, OneDirection, testing::ValuesIn(kStored),
                         [](const testing::TestParamInfo<Stored>& stored) {
                             return std::string(stored.param.name);
                         });

// Light from a cone about the vertical, as it comes together under a ball, on a floor that the eye
// sees from many sides: where it is bright and where it is not the lobe of the mean direction is
// wrong alone, and that of all directions on the whole right.
class ManyDirections : public testing::TestWithParam<double> {};

TEST_P(ManyDirections, AreReflectedAsTheMeanOfTheirBrdfs) {
    const Registry registry = registerAll();
    Suite suite;
    Lab lab(context(), registry, suite);
    double seen = 0.0;
    double expected = 0.0;
    double ofTheMean = 0.0;
    for (const double slant : {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0}) {
        const double angle = glm::radians(slant);
        const CameraText camera{{0.0, -1.0 + 3.0 * std::cos(angle), 3.0 * std::sin(angle) + 1e-3},
                                {0.0, -1.0, 0.0},
                                20.0,
                                0.01};
        const scene::Scene scene = makeScene(
            camera, sun({0, -1, 0}) + kPolished +
                        object("floor", "plane", "polished", {0, -1, 0}, "size = [4, 4]"));
        std::vector<StagePhoton> photons;
        const double half = glm::radians(GetParam());
        // Evenly over the cone's solid angle, in golden-ratio order, and evenly over a square.
        constexpr int kPhotons = 4096;
        for (int i = 0; i < kPhotons; ++i) {
            const double cosine = 1.0 - (i + 0.5) / kPhotons * (1.0 - std::cos(half));
            const double around = 2.399963229728653 * i;
            const double sine = std::sqrt(1.0 - cosine * cosine);
            StagePhoton photon;
            photon.direction = {sine * std::cos(around), -cosine, sine * std::sin(around)};
            photon.position = {0.2 * (i * 0.7548776662 - std::floor(i * 0.7548776662) - 0.5), -1.0,
                               0.2 * (i * 0.5698402910 - std::floor(i * 0.5698402910) - 0.5)};
            photon.fluxWatts = dvec3(1e-3);
            photon.startNormal = {0, 1, 0};
            photon.startMaterial = kMirror + 1;
            photons.push_back(photon);
        }
        const numerics::Frame frame =
            reconstructHits(lab, lab.choose(ReconstructStage::name, "fixed"), scene, photons,
                            {{"reconstruct.space", "light"},
                             {"gather", "project"},
                             {"filter", "none"},
                             {"reconstruct.map_size", "256"},
                             {"reconstruct.map_covers", "scene"}},
                            {96, 96});
        const Texels irradiance = frame.read(frame.renderer().outputs().caustic.irradiance);
        const Texels radiance = frame.read(frame.renderer().outputs().caustic.radiance);
        const dvec3 toEye = {0.0, std::cos(angle), std::sin(angle)};
        double mean = 0.0;
        for (const StagePhoton& photon : photons)
            mean += brdf(-photon.direction, toEye).g / kPhotons;
        // The middle of what is lit, 0.06 m to each side.
        double flux = 0.0;
        double reflected = 0.0;
        for (int y = 42; y < 54; ++y) {
            for (int x = 42; x < 54; ++x) {
                flux += irradiance.rgb(x, y).g;
                reflected += radiance.rgb(x, y).g;
            }
        }
        ASSERT_GT(flux, 0.0);
        // As light comes from all sides, each slant stands for the sine of its angle.
        const double weight = std::sin(std::max(angle, 0.05));
        seen += weight * reflected / flux;
        expected += weight * mean;
        ofTheMean += weight * brdf({0, 1, 0}, toEye).g;
    }
    RecordProperty("per_mille", static_cast<int>(1000.0 * seen / expected));
    RecordProperty("of_the_mean_per_mille", static_cast<int>(1000.0 * ofTheMean / expected));
    // Of a cone of 20 degrees the mean direction's own lobe has 4 % more, of one of 35 degrees 7 %.
    EXPECT_NEAR(seen, expected, 0.02 * expected);
}

INSTANTIATE_TEST_SUITE_P(OfHalfAngle, ManyDirections, testing::Values(1.0, 10.0, 20.0, 35.0),
                         [](const testing::TestParamInfo<double>& tested) {
                             return std::to_string(static_cast<int>(tested.param));
                         });

// A filter that loses half of the flux, and nothing of the directions that belong to it.
CausticMap halve(FrameBuilder& frame, const params::NoParams&, CausticMap map) {
    return filterMaps(
        frame, "filter.halve", "a test", std::move(map), [](graph::PassSetup&, Filtered&) {},
        [](const Filtered& data, gl::PassContext& context) {
            gl::Command command =
                filterCommand(context, "tests/gpu/shaders/filter_halve.comp", data.map);
            dispatchOverMap(command, data.map);
        });
}

TEST(DirectionsThatAreLongerThanOne, AreSaidByTheGatherThatReadsThem) {
    const scene::Scene scene = oneDirection();
    Registry registry = registerAll();
    registry.node<FilterStage>("halve", {"Loses half of the flux.", "", "A test."}, &halve);
    const numerics::FrameRequest request{
        64, 48, with(kSmall, {{"reconstruct.fixed.diameter", "3"}, {"filter", "halve"}})};
    const numerics::Frame frame(context(), registry, scene, registry.findTechnique("caustic_map"),
                                request);
    const std::vector<std::string> found = frame.renderer().foundWarnings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found.front().starts_with("gather.project ")) << found.front();
    // 2 (1 + d) - 1 = 1 + 2 d, of length 1.9 to 3.6.
    EXPECT_NE(found.front().find("mean directions"), std::string::npos);
}

}  // namespace
}  // namespace kaustik::test
