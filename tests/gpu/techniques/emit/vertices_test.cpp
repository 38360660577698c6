// SPDX-License-Identifier: MIT
// emit.vertices against closed forms of the light that falls on a surface, and against emit.grid.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/numerics/cases/scene_text.h"
#include "framework/pipeline/photon_texels.h"
#include "framework/transport/watts.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/scene_parts.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;

const CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};
const std::string kFloor = floorPlane("floor", "grey", 12, {0, -1, 0});

struct Emitted {
    std::vector<PhotonTexel> photons;   // those that are there
    std::vector<glm::dvec3> positions;  // their places in the world
    double watts = 0.0;                 // that the ledger says were emitted
    double balance = 0.0;
    double sum = 0.0;  // of the photons
};

Emitted emitFrom(const scene::Scene& scene, const std::string& emitter, Settings settings = {}) {
    settings.insert(settings.begin(), {"emit", emitter});
    const Frame frame(scene, 96, 72, settings,
                      {"photons.position", "photons.direction", "photons.flux", "photons.origin",
                       "photons.list", "hits.flux"});
    Emitted emitted;
    emitted.watts = frame.renderer().ledger().watts[kAccountEmitted];
    emitted.balance = frame.renderer().ledger().balance();
    const graph::Graph& graph = frame.renderer().graph();
    const auto words = [&](const char* name) {
        return frame.renderer().texture(graph.find(name)).read();
    };
    const std::vector<float> position = words("photons.position");
    const std::vector<float> direction = words("photons.direction");
    const std::vector<float> flux = words("photons.flux");
    const std::vector<float> origin = words("photons.origin");
    for (std::size_t i = 0; i < position.size(); i += 4) {
        PhotonTexel photon;
        photon.fate = static_cast<std::uint32_t>(direction[i + 3]);
        if (photon.fate == kFateNone) continue;
        photon.position = {position[i], position[i + 1], position[i + 2]};
        photon.footprintMeters = position[i + 3];
        photon.direction = {direction[i], direction[i + 1], direction[i + 2]};
        photon.fluxWatts = {flux[i], flux[i + 1], flux[i + 2]};
        photon.media = static_cast<std::uint32_t>(flux[i + 3]);
        photon.origin.cell = static_cast<std::uint32_t>(origin[i]);
        photon.origin.light = static_cast<std::uint32_t>(origin[i + 1]);
        emitted.photons.push_back(photon);
        emitted.positions.push_back(frame.toWorld(photon.position));
        emitted.sum += wattsOf(photon.fluxWatts);
    }
    return emitted;
}

// A sheet of 2 x 1.5 m at the origin.
std::string sheet(const std::string& shape, const std::string& rest = "") {
    return object("water", shape, "water", {0, 0, 0}, "size = [2, 1.5]\ncells = [16, 12]\n" + rest);
}

TEST(EmitVertices, FluxOnFlatWaterIsIrradianceTimesAreaTimesCosine) {
    const glm::dvec3 light = glm::normalize(glm::dvec3(0.6, -1.0, 0.3));
    for (const char* shape : {"plane", "water"}) {
        SCOPED_TRACE(shape);
        const scene::Scene scene = makeScene(kAbove, sun(light, 800.0) + sheet(shape) + kFloor);
        const Emitted emitted = emitFrom(scene, "vertices");
        EXPECT_EQ(emitted.photons.size(), 17u * 13u);
        const double expected = 800.0 * 2.0 * 1.5 * -light.y;
        // Some roundings of 6e-8 of 32-bit areas and fluxes.
        EXPECT_NEAR(emitted.watts, expected, 1e-5 * expected);
        EXPECT_NEAR(emitted.sum, expected, 1e-5 * expected);
        EXPECT_LT(std::abs(emitted.balance), 1e-6);
    }
}

TEST(EmitVertices, PhotonsLieAtTheirVerticesAndCarryTheirThirds) {
    // With another one next to it, the sheet is no grid.
    const scene::Scene scene =
        makeScene(kAbove, sun({0, -1, 0}, 900.0) + sheet("plane") +
                              floorPlane("pane", "glass", 1, {2, 0, 0}) + kFloor);
    const scene::Mesh& mesh = scene.meshes[scene.objects[0].mesh];
    std::vector<double> area(mesh.positions.size(), 0.0);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        const double third = glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                                    glm::dvec3(mesh.positions[t.z]) - a)) /
                             6.0;
        for (int i = 0; i < 3; ++i)
            area[t[i]] += third;
    }
    const Emitted emitted = emitFrom(scene, "vertices");
    ASSERT_EQ(emitted.photons.size(), mesh.positions.size() + 4);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const PhotonTexel& photon = emitted.photons[i];
        const std::size_t vertex = photon.origin.cell;
        ASSERT_LT(vertex, mesh.positions.size());
        EXPECT_LT(
            glm::length(emitted.positions[i] - mesh.origin - glm::dvec3(mesh.positions[vertex])),
            1e-5);
        EXPECT_NEAR(wattsOf(photon.fluxWatts), 900.0 * area[vertex], 1e-4 * 900.0 * area[vertex]);
        EXPECT_NEAR(photon.footprintMeters, std::sqrt(area[vertex]), 1e-4);
    }
}

// Corners of both kinds, that a cell's diagonal ends at and not.
TEST(EmitVertices, VerticesOfAGridStandForQuartersOfTheCellsAroundThem) {
    for (const char* shape : {"plane", "water"}) {
        SCOPED_TRACE(shape);
        const scene::Scene scene =
            makeScene(kAbove, sun({0, -1, 0}, 900.0) + sheet(shape) + kFloor);
        const Emitted emitted = emitFrom(scene, "vertices");
        ASSERT_EQ(emitted.photons.size(), 17u * 13u);
        const double quarter = 900.0 * 0.25 * (2.0 / 16.0) * (1.5 / 12.0);
        for (const PhotonTexel& photon : emitted.photons) {
            const unsigned column = photon.origin.cell % 17;
            const unsigned row = photon.origin.cell / 17;
            const double columns = column % 16 == 0 ? 1.0 : 2.0;
            const double rows = row % 12 == 0 ? 1.0 : 2.0;
            const double expected = columns * rows * quarter;
            EXPECT_NEAR(wattsOf(photon.fluxWatts), expected, 1e-5 * expected)
                << column << ", " << row;
        }
    }
}

TEST(EmitVertices, FluxOnABallIsTheGridsAndTheDiscs) {
    const scene::Scene scene = makeScene(
        kAbove,
        sun({0.3, -1.0, -0.2}, 1000.0) +
            object("ball", "sphere", "glass", {0.2, 0.3, 0}, "radius = 0.5\nsegments = 128") +
            kFloor);
    const Emitted vertices = emitFrom(scene, "vertices");
    const Emitted grid = emitFrom(scene, "grid", {{"emit.photons", "512x512"}});
    EXPECT_NEAR(vertices.watts, grid.watts, 0.01 * grid.watts);
    // A polyhedron of 128 segments lacks (π/128)²/2 or so of its disc.
    const double disc = 1000.0 * glm::pi<double>() * 0.25;
    EXPECT_NEAR(vertices.watts, disc, 2e-3 * disc);
    EXPECT_LT(std::abs(vertices.balance), 1e-6);
    EXPECT_GT(vertices.photons.size(), 3000u);
}

TEST(EmitVertices, ABallIsLitAlikeAllAround) {
    const glm::dvec3 middle(0.0, 0.3, 0.0);
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) +
                    object("ball", "sphere", "glass", middle, "radius = 0.5\nsegments = 96") +
                    kFloor);
    const Emitted emitted = emitFrom(scene, "vertices");
    glm::dvec3 first(0.0);
    glm::dvec3 second(0.0);
    for (std::size_t i = 0; i < emitted.photons.size(); ++i) {
        const glm::dvec3 p = emitted.positions[i] - middle;
        const double share = wattsOf(emitted.photons[i].fluxWatts) / emitted.sum;
        first += share * p;
        second += share * p * p;
        EXPECT_GT(p.y, -0.03);  // those below the equator face away, the first row of them in part
    }
    // Triangles' diagonals run one way: what a vertex gets is off by some of that.
    EXPECT_NEAR(first.x, 0.0, 1e-4);
    EXPECT_NEAR(first.z, 0.0, 1e-4);
    // Uniform over a disc: r²/4 along both axes, and a mean height of 2/3 r; corners in place of
    // triangles of 2π/96 radii add about the square of that over 4.
    EXPECT_NEAR(second.x, 0.0625, 2e-3 * 0.0625);
    EXPECT_NEAR(second.z, 0.0625, 2e-3 * 0.0625);
    EXPECT_NEAR(second.x, second.z, 1e-5 * 0.0625);
    EXPECT_NEAR(first.y, 2.0 / 3.0 * 0.5, 2e-3 * 0.5);
}

TEST(EmitVertices, AShadowedVertexEmitsNothing) {
    // Vertices every 12.5 cm along x; the plate ends between two columns of them, at x = 0.05.
    for (const double height : {0.05, 0.5}) {
        SCOPED_TRACE(height);
        const scene::Scene scene = makeScene(
            kAbove, sun({0, -1, 0}) + sheet("water") + kFloor +
                        object("plate", "plane", "grey", {-1.95, height, 0}, "size = [4, 4]"));
        const Emitted emitted = emitFrom(scene, "vertices");
        EXPECT_EQ(emitted.photons.size(), 8u * 13u);
        for (const glm::dvec3& position : emitted.positions)
            EXPECT_GT(position.x, 0.1);
    }
    // A plate below the water hides nothing of it.
    const scene::Scene below =
        makeScene(kAbove, sun({0, -1, 0}) + sheet("water") + kFloor +
                              object("plate", "plane", "grey", {-1.95, -0.05, 0}, "size = [4, 4]"));
    EXPECT_EQ(emitFrom(below, "vertices").photons.size(), 17u * 13u);
}

TEST(EmitVertices, WaterBehindTheWallOfItsBasinEmitsNothing) {
    // By 2 mm, a texel of the light's depths, on the sides that the sun shines towards.
    const scene::Scene scene =
        makeScene(kAbove, sun({0.22, -1.0, -0.15}) + sheet("water") +
                              object("basin", "box", "grey", {0, -0.15, 0},
                                     "size = [1.996, 0.7, 1.496]\ninward = true\nopen = [\"+y\"]"));
    const Emitted emitted = emitFrom(scene, "vertices");
    EXPECT_GE(emitted.photons.size(), 15u * 11u);
    for (const glm::dvec3& position : emitted.positions) {
        // From outside, past the ends of those walls, it comes over the water's other edges.
        if (position.x < -0.99 || position.z > 0.74) continue;
        EXPECT_LT(position.x, 0.99) << position.z;
        EXPECT_GT(position.z, -0.74) << position.x;
    }
}

TEST(EmitVertices, AMirrorInTheShadowOfGlassEmitsNothing) {
    // What is first is what counts, specular or not.
    const scene::Scene scene = makeScene(
        kAbove,
        sun({0, -1, 0}) + sheet("plane") +
            object("mirror", "plane", "mirror", {0, -0.5, 0}, "size = [1, 1]\ncells = [8, 8]") +
            kFloor);
    const Emitted emitted = emitFrom(scene, "vertices");
    EXPECT_EQ(emitted.photons.size(), 17u * 13u);
    for (const glm::dvec3& position : emitted.positions)
        EXPECT_NEAR(position.y, 0.0, 1e-5);
}

TEST(EmitVertices, ASheetTakesLightFromBelow) {
    const scene::Scene scene = makeScene(kAbove, sun({0, 1, 0}, 500.0) + sheet("plane") + kFloor +
                                                     floorPlane("sky", "grey", 8, {0, 2, 0}));
    // The floor is first, seen from below: a hole in it is what lets light through.
    EXPECT_EQ(emitFrom(scene, "vertices").photons.size(), 0u);
    const scene::Scene lit = makeScene(
        kAbove, sun({0, 1, 0}, 500.0) + sheet("plane") + floorPlane("sky", "grey", 8, {0, 2, 0}));
    const Emitted emitted = emitFrom(lit, "vertices");
    EXPECT_NEAR(emitted.watts, 500.0 * 3.0, 1e-5 * 1500.0);
    for (const PhotonTexel& photon : emitted.photons)
        EXPECT_NE(photon.media, 0u);  // light comes from within the water
}

std::string lamp(const std::string& type, const std::string& rest) {
    return fmt::format(
        "[[light]]\nname = \"lamp\"\ntype = \"{}\"\nposition = [0.3, 1.5, 0.2]\nintensity = 60\n{}",
        type, rest);
}

TEST(EmitVertices, LampsGiveWhatTheyGiveToTheGrid) {
    for (const std::string& light :
         {lamp("point", ""), lamp("spot",
                                  "direction = [-0.2, -1, 0]\ninner_cone_degrees = 10\n"
                                  "outer_cone_degrees = 25\n")}) {
        const scene::Scene scene = makeScene(kAbove, light + rippledWater() + kFloor);
        const Emitted vertices = emitFrom(scene, "vertices");
        const Emitted grid = emitFrom(scene, "grid", {{"emit.photons", "256x256"}});
        // The edge of a cone crosses cells of 2 cm.
        EXPECT_NEAR(vertices.watts, grid.watts, 5e-3 * grid.watts);
        EXPECT_GT(vertices.watts, 1.0);
    }
}

TEST(EmitVertices, TwoLightsGiveTheSumOfEach) {
    const std::string first = sun({0.2, -1, 0}, 300.0);
    const std::string second = lamp("point", "");
    const auto watts = [&](const std::string& lights) {
        return emitFrom(makeScene(kAbove, lights + sheet("water") + kFloor), "vertices").watts;
    };
    const double both = watts(first + second);
    EXPECT_NEAR(both, watts(first) + watts(second), 1e-6 * both);
}

TEST(EmitVertices, BatchesDoNotChangeTheLight) {
    const scene::Scene scene = makeScene(
        kAbove, sun({0.2, -1, 0.1}) + lamp("point", "") + rippledWater({64, 48}) + kFloor);
    const Frame whole(scene, 160, 120, {{"emit", "vertices"}});
    const Frame parts(scene, 160, 120, {{"emit", "vertices"}, {"emit.batch", "1024"}});
    const std::vector<float> a = whole.causticIrradiance().values;
    const std::vector<float> b = parts.causticIrradiance().values;
    EXPECT_GT(*std::max_element(a.begin(), a.end()), 0.0f);
    EXPECT_EQ(a, b);
    EXPECT_EQ(whole.renderer().ledger().watts[kAccountEmitted],
              parts.renderer().ledger().watts[kAccountEmitted]);
}

TEST(EmitVertices, CausticOfWavesIsTheGrids) {
    const scene::Scene scene = makeScene(
        kAbove,
        sun({0.1, -1, 0.05}) +
            object("water", "water", "water", {0, 0, 0},
                   "size = [2, 1.5]\ncells = [128, 96]\n"
                   "waves = [{amplitude = 0.01, wavelength = 0.7, direction_degrees = 30}]") +
            kFloor);
    const Frame vertices(scene, 200, 150, {{"emit", "vertices"}}, {}, false, "planar");
    const Frame grid(scene, 200, 150, {{"emit.photons", "128x96"}}, {}, false, "planar");
    const Texels a = vertices.causticIrradiance();
    const Texels b = grid.causticIrradiance();
    double difference = 0.0;
    double total = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            difference += std::abs(a.rgb(x, y).g - b.rgb(x, y).g);
            total += b.rgb(x, y).g;
        }
    }
    EXPECT_GT(total, 0.0);
    // Photons at the cells' corners in place of their middles; the waves are smooth over both.
    EXPECT_LT(difference / total, 0.05);
    EXPECT_NEAR(a.sum(), b.sum(), 0.01 * b.sum());
}

}  // namespace
}  // namespace kaustik::test
