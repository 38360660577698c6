// SPDX-License-Identifier: MIT
// Caustic triangles (U08): which generators there are, light stored on the faces around them and
// looked up from there, and what the eye sees of it in mirrors and through glass. Closed forms.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/scene/files/scene_file.h"
#include "framework/transport/brdf.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;

constexpr double kSunlight = 1000.0;

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

numerics::Frame render(const scene::Scene& scene, Settings settings,
                       const std::vector<std::string>& saved = {}) {
    Settings all{{"emit.photons", "64x64"}, {"reconstruct.map_size", "512"}};
    all.insert(all.end(), settings.begin(), settings.end());
    FrameRequest request{64, 64, all, saved};
    return {context(), registry(), scene, registry().findTechnique("caustic_triangles"), request};
}

std::size_t generatorsOf(const scene::Scene& scene, const Settings& settings = {}) {
    Settings all{
        {"emit.photons", "8x8"}, {"reconstruct.map_size", "64"}, {"around.cubes.size", "32"}};
    all.insert(all.end(), settings.begin(), settings.end());
    const numerics::Frame frame = render(scene, all);
    return frame.renderer().outputs().map.maps.size();
}

std::string ball(const std::string& name, const glm::dvec3& position, double radius) {
    return object(name, "sphere", "glass", position,
                  fmt::format("radius = {}\nsegments = 16", number(radius)));
}

const std::string kFloor = floorPlane("floor", "grey", 12, {0, 0, 0});
const std::string kSpot =
    "[[light]]\nname = \"spot\"\ntype = \"spot\"\nposition = [-2, 4, 0]\ndirection = [0, -1, 0]\n"
    "inner_cone_degrees = 8\nouter_cone_degrees = 10\nintensity = 100\n";

const CameraText kCamera{{0.0, 6.0, 6.0}, {0.0, 0.0, 0.0}};

// The slots of layers around a generator: kinds have theirs one after the other, each the first
// that none has that it is seen with (shaders/around/cubes_order_slots.comp, where threads share
// the work).
std::vector<std::uint32_t> slotsInTurn(const std::vector<std::uint32_t>& conflicts, int layers) {
    constexpr std::size_t kKinds = 256;
    constexpr std::uint32_t kNoSlot = 15;
    std::vector<std::uint32_t> slots(kKinds, 0);
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
        std::uint32_t taken = 0;
        for (std::size_t other = 0; other < kind; ++other) {
            const std::uint32_t word = conflicts.at(kind * kKinds / 32 + other / 32);
            if ((word >> (other % 32) & 1u) != 0) taken |= 1u << slots[other];
        }
        const auto slot = static_cast<std::uint32_t>(std::countr_one(taken));
        slots[kind] = slot < static_cast<std::uint32_t>(layers) ? slot : kNoSlot;
    }
    return slots;
}

TEST(LayersAroundGenerators, HaveTheSlotsThatKindsTakeInTurn) {
    const scene::Scene scene = scene::loadScene("cornell-bunny");
    // Fewer slots than kinds that are seen with each other, too.
    for (const int layers : {2, 8}) {
        const Settings settings = {{"emit.photons", "8x8"},
                                   {"reconstruct.map_size", "64"},
                                   {"around.cubes.size", "64"},
                                   {"around.cubes.layers", std::to_string(layers)}};
        std::vector<std::string> saved;
        for (const std::string& name : render(scene, settings).renderer().graph().resourceNames()) {
            if (name.starts_with("around.conflicts") || name.starts_with("around.slots"))
                saved.push_back(name);
        }
        ASSERT_FALSE(saved.empty());
        const numerics::Frame frame = render(scene, settings, saved);
        const auto read = [&](const std::string& name) {
            const Renderer& renderer = frame.renderer();
            return renderer.buffer(renderer.graph().find(name)).read<std::uint32_t>();
        };
        std::set<std::uint32_t> taken;
        for (const std::string& name : saved) {
            if (!name.starts_with("around.conflicts")) continue;
            const std::string suffix = name.substr(std::string("around.conflicts").size());
            const std::vector<std::uint32_t> slots = read("around.slots" + suffix);
            EXPECT_EQ(slots, slotsInTurn(read(name), layers)) << suffix << " of " << layers;
            taken.insert(slots.begin(), slots.end());
        }
        EXPECT_GE(taken.size(), 2u);  // or there was nothing to choose
    }
}

TEST(CausticGenerators, AreOneAnObject) {
    EXPECT_EQ(
        generatorsOf(makeScene(kCamera, sun({0, -1, 0}) + kFloor + ball("a", {-2, 1, 0}, 0.3) +
                                            ball("b", {2, 1, 0}, 0.3))),
        2u);
}

TEST(CausticGenerators, ThatNoLightReachesAreNone) {
    EXPECT_EQ(generatorsOf(makeScene(kCamera, kSpot + kFloor + ball("a", {-2, 1, 0}, 0.3) +
                                                  ball("b", {2, 1, 0}, 0.3))),
              1u);
}

TEST(CausticGenerators, WhoseBoxesOverlapAreOne) {
    EXPECT_EQ(generatorsOf(makeScene(kCamera, sun({0, -1, 0}) + kFloor + ball("a", {0, 1, 0}, 0.3) +
                                                  ball("b", {0.4, 1, 0}, 0.3))),
              1u);
}

TEST(CausticGenerators, AreNoMoreThanMayBe) {
    std::string balls;
    for (int i = 0; i < 5; ++i)
        balls += ball(fmt::format("ball {}", i), {2.0 * i - 4.0, 1, 0}, 0.2);
    const scene::Scene scene = makeScene(kCamera, sun({0, -1, 0}) + kFloor + balls);
    EXPECT_EQ(generatorsOf(scene, {{"around.max_generators", "3"}}), 3u);
    EXPECT_EQ(generatorsOf(scene, {{"around.max_generators", "1"}}), 1u);
}

TEST(CausticGenerators, MayHaveSeveralReferencePoints) {
    const scene::Scene scene =
        makeScene(kCamera, sun({0, -1, 0}) + kFloor + ball("a", {0, 1, 0}, 0.3));
    EXPECT_EQ(generatorsOf(scene, {{"around.points", "4"}}), 4u);
}

// Water around a pillar, which hides half of what light from the water reaches wherever one stands.
scene::Scene pondAroundAPillar() {
    return makeScene(kCamera,
                     sun({0, -1, 0}) + kFloor + floorPlane("pond", "water", 8, {0, 1, 0}) +
                         object("pillar", "box", "white", {0, 1.5, 0}, "size = [3.0, 3.0, 3.0]"));
}

TEST(CausticGenerators, HaveAsManyReferencePointsAsSeeWhatTheirLightMayReach) {
    const scene::Scene small =
        makeScene(kCamera, sun({0, -1, 0}) + kFloor + ball("a", {0, 1, 0}, 0.3));
    EXPECT_EQ(generatorsOf(small), 1u);
    const scene::Scene wide =
        makeScene(kCamera, sun({0, -1, 0}) + kFloor + floorPlane("pond", "water", 8, {0, 1, 0}));
    EXPECT_EQ(generatorsOf(wide), 1u);
    EXPECT_GT(generatorsOf(pondAroundAPillar()), 1u);
}

TEST(CausticGenerators, LoseNextToNothingBehindWhatStandsInThem) {
    const auto hidden = [](const Settings& settings) {
        const numerics::Frame frame = render(pondAroundAPillar(), settings);
        const EnergyLedger ledger = frame.renderer().ledger();
        return ledger.watts[transport::kAccountHiddenInMap] /
               ledger.watts[transport::kAccountEmitted];
    };
    EXPECT_GT(hidden({{"around.points", "1"}}), 0.1);
    EXPECT_LT(hidden({}), 0.02);
}

TEST(CausticGenerators, OneWithTooFewPointsIsNamedWithANumberThatHelps) {
    const numerics::Frame frame = render(pondAroundAPillar(), {{"around.points", "1"}});
    const auto& warnings = frame.renderer().warnings();
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
        return warning.find("'pond'") != std::string::npos &&
               warning.find("around.points = ") != std::string::npos;
    }));
    const numerics::Frame enough = render(pondAroundAPillar(), {});
    for (const std::string& warning : enough.renderer().warnings())
        EXPECT_EQ(warning.find("around.points"), std::string::npos) << warning;
}

// A sheet that bends nothing stores all light that comes down through it.
scene::Scene underASheet(const CameraText& camera, const std::string& parts) {
    scene::Scene scene = makeScene(camera, sun({0, -1, 0}, kSunlight) + kFloor +
                                               floorPlane("air", "water", 6, {0, 2, 0}) + parts);
    scene.materials[kWater - 1].ior = 1.0f;
    return scene;
}

TEST(CausticTriangles, MayShareAGeneratorAmongPointsWithoutASeam) {
    const scene::Scene scene = underASheet({{0.0, 1.8, 2.5}, {0.0, 0.0, 0.0}}, "");
    for (const char* points : {"1", "4"}) {
        const numerics::Frame frame = render(scene, {{"around.points", points}}, {"eye.receiver"});
        const Texels irradiance = frame.causticIrradiance();
        const Texels receiver = frame.read("eye.receiver");
        double worst = 0.0;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const glm::dvec3 at =
                    frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
                if (receiver.at(x, y, 0) <= 0.0f ||
                    std::max(std::abs(at.x), std::abs(at.z)) > 2.5) {
                    continue;
                }
                worst = std::max(worst, std::abs(irradiance.rgb(x, y).g / kSunlight - 1.0));
            }
        }
        // What lies between two photons is joined whichever parts they have left, and where one map
        // passes light on to the next both have some of it. What is left is that their texels
        // blur one step of that, a tenth or less of the light, over unlike widths.
        EXPECT_LT(worst, std::string(points) == "1" ? 0.01 : 0.02) << points;
        const EnergyLedger ledger = frame.renderer().ledger();
        EXPECT_NEAR(
            ledger.watts[transport::kAccountDeposited] / ledger.watts[transport::kAccountArrived],
            1.0, 1e-5);
    }
}

// With power by the areas round a vertex, a third of which are its own: a half would leave 2/3.
TEST(CausticTriangles, HaveTheLightOfTheirVerticesForAThirdOfTheAreasThere) {
    const scene::Scene scene = underASheet({{0.0, 1.8, 0.01}, {0.0, 0.0, 0.0}}, "");
    for (const char* shading : {"vertices", "smooth", "flat"}) {
        const numerics::Frame frame = render(scene, {{"reconstruct.triangles.shading", shading}});
        EXPECT_NEAR(frame.causticIrradiance().rgb(32, 32).g, kSunlight, 0.005 * kSunlight)
            << shading;
    }
}

TEST(CausticTriangles, MergedHaveTheSameFlux) {
    const scene::Scene scene = underASheet({{0.0, 1.8, 0.01}, {0.0, 0.0, 0.0}}, "");
    for (const char* merge : {"0", "4", "64"}) {
        const numerics::Frame frame =
            render(scene, {{"emit.photons", "256x256"}, {"reconstruct.triangles.merge", merge}});
        const EnergyLedger ledger = frame.renderer().ledger();
        EXPECT_NEAR(
            ledger.watts[transport::kAccountDeposited] / ledger.watts[transport::kAccountArrived],
            1.0, 1e-5)
            << merge;
        EXPECT_NEAR(frame.causticIrradiance().rgb(32, 32).g, kSunlight, 0.005 * kSunlight) << merge;
    }
}

// A photon at the border of one batch is joined to those of the next, and what its flux is shared
// out by lies in both.
TEST(CausticTriangles, AreTheSameWhateverTheBatches) {
    const scene::Scene scene = underASheet({{0.0, 1.8, 0.01}, {0.0, 0.0, 0.0}}, "");
    for (const char* merge : {"0", "8"}) {
        SCOPED_TRACE(merge);
        const Settings settings = {{"reconstruct.triangles.merge", merge}};
        const numerics::Frame whole = render(scene, settings);
        Settings batched = settings;
        batched.emplace_back("emit.batch", "1000");
        const numerics::Frame parts = render(scene, batched);
        EXPECT_GT(whole.causticIrradiance().sum(), 0.0);
        EXPECT_EQ(whole.causticIrradiance().values, parts.causticIrradiance().values);
        EXPECT_EQ(whole.renderer().ledger().watts, parts.renderer().ledger().watts);
    }
}

// The eye looks into a mirror, at a floor that only light through the sheet lights.
TEST(CausticsSeen, InAMirrorAreThoseOfWhatItShows) {
    const scene::Scene scene =
        underASheet({{0.0, 0.8, 1.0}, {0.0, 0.8, -1.0}},
                    object("mirror", "plane", "mirror", {0, 0.8, -1.5},
                           "size = [1.6, 1.6]\nrotation_degrees = [105, 0, 0]"));
    const numerics::Frame frame = render(scene, {}, {"view.radiance", "eye.interface"});
    const Texels radiance = frame.read("view.radiance");
    const double expected = 0.9 * 0.5 / std::numbers::pi * kSunlight;
    EXPECT_GT(frame.read("eye.interface").at(32, 32, 0), 0.0f);
    EXPECT_NEAR(radiance.rgb(32, 32).g, expected, 0.01 * expected);
    const numerics::Frame without =
        render(scene, {{"view.around.caustics", "off"}}, {"view.radiance"});
    EXPECT_EQ(without.read("view.radiance").rgb(32, 32).g, 0.0);
}

TEST(CausticsSeen, ThroughGlassAreWeakenedByBothInterfaces) {
    scene::Scene scene =
        underASheet({{0.0, 1.5, 0.01}, {0.0, 0.0, 0.0}},
                    object("slab", "box", "glass", {0, 0.8, 0}, "size = [0.8, 0.1, 0.8]"));
    const numerics::Frame frame = render(scene, {}, {"view.radiance"});
    // Light that comes down through the slab has lost 4 % at each side of it, and so has the eye's.
    const double transmitted = 0.96 * 0.96;
    const double expected = 0.5 / std::numbers::pi * kSunlight * transmitted * transmitted;
    EXPECT_NEAR(frame.read("view.radiance").rgb(32, 32).g, expected, 0.03 * expected);
}

// Waves that bend nothing: below them the floor has the sun's light as caustic light alone,
// whatever the reference point sees of the waves. The border of the waves, where cells end, is out
// of the picture.
TEST(CausticsSeen, ThroughWavesHaveNoDirectLightBesides) {
    scene::Scene scene = makeScene(
        {{0.0, 2.2, 0.8}, {0.0, 0.0, 0.0}},
        sun({0.22, -1, -0.15}, kSunlight) + kFloor +
            object("waves", "water", "water", {0, 1.2, 0},
                   "size = [5, 5]\ncells = [128, 128]\n"
                   "waves = [{amplitude = 0.03, wavelength = 0.6, direction_degrees = 20, phase = "
                   "0.4}, {amplitude = 0.02, wavelength = 0.4, direction_degrees = 110, phase = "
                   "2.0}]"));
    scene.materials[kWater - 1].ior = 1.0f;
    const numerics::Frame frame = render(scene, {}, {"view.radiance", "eye.interface"});
    const Texels radiance = frame.read("view.radiance");
    const Texels interface = frame.read("eye.interface");
    const double cosine = 1.0 / std::sqrt(1.0 + 0.22 * 0.22 + 0.15 * 0.15);
    const double expected = 0.5 / std::numbers::pi * kSunlight * cosine;
    std::size_t pixels = 0;
    double most = 0.0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (interface.at(x, y, 0) <= 0.0f) continue;
            ++pixels;
            most = std::max(most, radiance.rgb(x, y).g);
        }
    }
    EXPECT_GT(pixels, 1000u);
    // Between light from both sides of a crest, of cells that are 8 cm wide, there is some too
    // much.
    EXPECT_LT(most, 1.3 * expected);
}

// A glossy receiver reflects light that comes straight down as such, wherever the reference point
// is; from there it comes where that is said.
TEST(LightCube, OnAGlossyReceiverComesFromWhereItCame) {
    scene::Scene scene = underASheet({{1.5, 1.5, 0.01}, {1.5, 0.0, 0.0}}, "");
    scene::Material& floor = scene.materials[kGrey - 1];
    floor.kind = scene::MaterialKind::glossy;
    floor.specular = glm::vec3(0.3f);
    floor.exponent = 50.0f;
    const auto seen = [&](const char* incidence) {
        const numerics::Frame frame = render(scene, {{"gather.cube.incidence", incidence}},
                                             {"eye.receiver", "caustic.radiance"});
        const Texels receiver = frame.read("eye.receiver");
        const glm::dvec3 at = frame.worldAt(32, 32, static_cast<double>(receiver.at(32, 32, 0)));
        const glm::dvec3 toEye = glm::normalize(scene.camera.position - at);
        const double expected =
            kSunlight * transport::receiverBrdf(glm::dvec3(0.5), glm::dvec3(0.3), 50.0, {0, 1, 0},
                                                {0, 1, 0}, toEye)
                            .g;
        return frame.read("caustic.radiance").rgb(32, 32).g / expected;
    };
    EXPECT_NEAR(seen("mean"), 1.0, 0.02);
    EXPECT_GT(std::abs(seen("centre") - 1.0), 0.3);
}

void expectHelpful(const Settings& settings, const std::string& node) {
    const scene::Scene scene = underASheet({{0.0, 1.8, 0.01}, {0.0, 0.0, 0.0}}, "");
    try {
        (void)render(scene, settings);
        ADD_FAILURE() << node << " does not complain";
    } catch (const ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find(node), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("take "), std::string::npos) << error.what();
    }
}

TEST(LightCube, IsLookedUpByItsOwnNode) {
    expectHelpful({{"gather", "project"}}, "gather.project");
    expectHelpful({{"gather", "screen"}}, "gather.screen");
    expectHelpful({{"reconstruct.space", "screen"}}, "gather.cube");
    expectHelpful({{"reconstruct.space", "light"}}, "gather.cube");
}

TEST(LayersAround, ThatDoNotFitIntoTheirMemoryAreSmallerAndSaidToBe) {
    const scene::Scene scene = underASheet({{0.0, 1.8, 0.01}, {0.0, 0.0, 0.0}}, "");
    const numerics::Frame frame =
        render(scene, {{"around.cubes.size", "512"}, {"around.cubes.memory", "60"}});
    const auto& warnings = frame.renderer().warnings();
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
        return warning.find("around.cubes.memory") != std::string::npos &&
               warning.find("they have 256") != std::string::npos;
    }));
}

}  // namespace
}  // namespace kaustik::test
