// SPDX-License-Identifier: MIT
// A mesh of one's own as a scene: stood on a table, into a pool or a room, in one command.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/cli/fixture.h"
#include "tests/unit/importers/gltf_file_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4";  // without an end

class OwnMesh : public CommandLine {
  protected:
    OwnMesh() { static_cast<void>(folder.file("thing.obj", kTetrahedron)); }
    [[nodiscard]] Outcome render(const std::string& scene,
                                 std::vector<std::string> options = {}) const {
        options.insert(options.end(), {"--set", "photons=64x64", "--out", "out"});
        return run(smallRun(scene, options));
    }
    void expectCaustic() const {
        const json energy = report().at("energy");
        EXPECT_GT(energy.at("emitted_w").get<double>(), 0.0);
        EXPECT_GT(energy.at("deposited_w").get<double>(), 0.0);
        EXPECT_EQ(report().at("violations"), json::array());
    }
    // The normals of a tetrahedron's corners are far from those of its faces, which light may meet
    // or not; nothing else is warned of.
    void expectNoWarningButOfNormals() {
        for (const json& warning : report().at("warnings"))
            EXPECT_NE(warning.get<std::string>().find("met a normal"), std::string::npos)
                << warning;
    }
    // Of glass, without a lamp and a camera.
    void writeGlassGlb() const {
        json scene = scene::test::tetrahedronScene();
        scene["nodes"] = json::array({scene["nodes"][0]});
        scene["scenes"][0]["nodes"] = {0};
        scene.erase("cameras");
        scene.erase("extensions");
        static_cast<void>(
            folder.file("thing.glb", scene::test::glb(scene, scene::test::tetrahedronBytes())));
    }
};

TEST_F(OwnMesh, StandsOnTheTableInThePoolAndInTheRoom) {
    for (const char* place : {"table", "pool", "room"}) {
        SCOPED_TRACE(place);
        const Outcome outcome = render("thing.obj", {"--on", place});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(report().at("scene").at("name"), std::string("thing-on-") + place);
        expectNoWarningButOfNormals();
        expectCaustic();
    }
}

TEST_F(OwnMesh, AloneStandsOnATableOfGlass) {
    ASSERT_EQ(render("thing.obj").exitCode, 0);
    EXPECT_EQ(report().at("scene").at("name"), "thing-on-table");
    EXPECT_EQ(report().at("scene").at("needs").at("refractors"), 1);
    expectCaustic();
}

TEST_F(OwnMesh, HasTheRequestedMaterial) {
    ASSERT_EQ(render("thing.obj", {"--material", "gold"}).exitCode, 0);
    EXPECT_EQ(report().at("scene").at("needs").at("refractors"), 0);
    EXPECT_EQ(report().at("scene").at("needs").at("reflectors"), 1);
    expectCaustic();
}

// Where z is up its height is along y in the world: 3 of its sides 1, 2 and 3.
TEST_F(OwnMesh, ThatHasZUpIsTurned) {
    ASSERT_EQ(render("thing.obj", {"--set", "specular.bounces=8"}).exitCode, 0);
    const json before = report().at("energy");
    ASSERT_EQ(render("thing.obj", {"--up", "z"}).exitCode, 0);
    // The sun sees another side of it.
    EXPECT_NE(report().at("energy").at("emitted_w"), before.at("emitted_w"));
    expectFailure(render("thing.obj", {"--up", "x"}), 2, {"up=y"});
}

TEST_F(OwnMesh, AsAGlbKeepsItsGlassUnlessAskedForAnother) {
    writeGlassGlb();
    ASSERT_EQ(render("thing.glb", {"--on", "table"}).exitCode, 0);
    EXPECT_EQ(report().at("scene").at("needs").at("refractors"), 1);
    expectNoWarningButOfNormals();
    expectCaustic();
    ASSERT_EQ(render("thing.glb", {"--on", "table", "--material", "mirror"}).exitCode, 0);
    EXPECT_EQ(report().at("scene").at("needs").at("reflectors"), 1);
    expectCaustic();
}

TEST_F(OwnMesh, AsAGlbThatNothingLightsIsStoodOnATable) {
    writeGlassGlb();
    ASSERT_EQ(render("thing.glb").exitCode, 0);
    EXPECT_EQ(report().at("scene").at("name"), "thing-on-table");
    const json warnings = report().at("warnings");
    ASSERT_EQ(warnings.size(), 2u) << warnings;
    EXPECT_NE(warnings[0].get<std::string>().find("--on"), std::string::npos);
    EXPECT_NE(warnings[1].get<std::string>().find("met a normal"), std::string::npos);
    expectCaustic();
}

TEST_F(OwnMesh, AsAGlbIsAMeshOfASceneFileToo) {
    writeGlassGlb();
    std::string scene = kWavyWater;
    scene +=
        "[[object]]\nname = \"thing\"\nmaterial = \"water\"\nmesh = \"thing.glb\"\n"
        "fit = {size = 0.1}\nposition = [0, -0.3, 0]\n";
    static_cast<void>(folder.file("with.toml", scene));
    const Outcome outcome = render("with.toml");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(report().at("scene").at("needs").at("refractors"), 2);
}

TEST_F(OwnMesh, OfStlIsReadInBothForms) {
    std::string text = "solid thing of mine\n";
    std::string binary(80, ' ');
    binary.replace(0, 5, "solid");
    binary += scene::test::word32(4);
    const std::vector<std::vector<float>> corners{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    for (const auto& face :
         std::vector<std::vector<std::size_t>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
        text += "facet normal 0 0 0\nouter loop\n";
        binary += scene::test::floatBytes({0, 0, 0});
        for (const std::size_t i : face) {
            text += fmt::format("vertex {} {} {}\n", corners[i][0], corners[i][1], corners[i][2]);
            binary += scene::test::floatBytes(corners[i]);
        }
        text += "endloop\nendfacet\n";
        binary += std::string(2, '\0');
    }
    static_cast<void>(folder.file("text.stl", text + "endsolid thing"));
    static_cast<void>(folder.file("binary.stl", binary));
    static_cast<void>(folder.file("cut.stl", binary.substr(0, binary.size() - 1)));
    for (const char* file : {"text.stl", "binary.stl"}) {
        ASSERT_EQ(render(file).exitCode, 0) << file;
        EXPECT_EQ(report().at("scene").at("triangles"), 6) << file;  // two of them the table's
        expectCaustic();
    }
    expectFailure(render("cut.stl"), 1, {"cut.stl", "3 of 4 triangles"});
}

TEST_F(OwnMesh, IsRefusedInASentence) {
    expectFailure(render("thing.obj", {"--on", "tabel"}), 2, {"'tabel'", "table", "pool"});
    expectFailure(render("thing.obj", {"--material", "cheese"}), 2, {"cheese", "glass"});
    expectFailure(render("none.obj"), 1, {"none.obj", "no such file"});
    expectFailure(render("pool", {"--on", "table"}), 2, {"'pool' is a scene"});
    expectFailure(render("pool", {"--material", "glass"}), 2, {"'pool' is a scene"});
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    expectFailure(render("thing.obj", {"--on", "wavy.toml"}), 2, {"wavy.toml", "\"own\""});
}

// What becomes of the eye's rays, in a body without a back and through a pane with two slivers.
class EyesRays : public CommandLine {
  protected:
    static constexpr const char* kRoom = R"(name = "room"
[camera]
position = [0, 1, 6]
target = [0, 1, 0]
vertical_fov_degrees = 24
[[light]]
name = "lamp"
type = "point"
position = [0, 1.8, -0.6]
intensity = 20
[[material]]
name = "white"
type = "lambertian"
albedo = [0.7, 0.7, 0.7]
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "room"
material = "white"
shape = "box"
size = [2, 2, 2]
inward = true
open = ["+z"]
position = [0, 1, -1]
[[object]]
name = "pane"
material = "water"
)";
    [[nodiscard]] Outcome look(const std::string& object, std::vector<std::string> options = {}) {
        static_cast<void>(folder.file("room.toml", kRoom + object));
        options.insert(options.end(), {"--set", "photons=32x32", "--out", "out"});
        return run(smallRun("room.toml", options));
    }
    [[nodiscard]] double shareOf(const char* fate) const {
        const json rays = report().at("eye_rays");
        return rays.at(fate).get<double>() / rays.at("pixels").get<double>();
    }
    [[nodiscard]] bool isLimitReached(const std::string& name) const {
        const json limits = report().at("limits");
        for (const json& limit : limits) {
            if (limit.at("limit") == name) return true;
        }
        return false;
    }
};

// ../shared/found/slivers.toml: 99.99 % of these rays were lost, in silence.
TEST_F(EyesRays, GoThroughAPaneWithSlivers) {
    std::string pane;
    for (int j = 0; j <= 16; ++j) {
        for (int i = 0; i <= 16; ++i)
            pane += fmt::format("v {} {} 0\n", -1.0 + i / 8.0, j / 8.0);
    }
    for (int j = 0; j < 16; ++j) {
        for (int i = 1; i <= 16; ++i) {
            const int a = j * 17 + i;
            pane += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, a + 18, a, a + 18, a + 17);
        }
    }
    pane +=
        "v 0.1 0.1 0\nv 0.1 0.10001 0\nv 0.1 0.1 0.000004\n"
        "v 0.1 0.1 0\nv 0.1 0.10001 0\nv 0.1 0.1 -0.000004\nf 290 291 292\nf 293 294 295";
    static_cast<void>(folder.file("pane.obj", pane));
    const Outcome outcome = look("mesh = \"pane.obj\"\n");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_GT(report().at("eye_rays").at("pixels"), 500);
    EXPECT_GT(shareOf("came_out"), 0.99);
    EXPECT_FALSE(isLimitReached("view.refraction"));
    EXPECT_NE(outcome.out.find("eye's rays"), std::string::npos) << outcome.out;
}

TEST_F(EyesRays, ThatAreLostAreTold) {
    const std::string body =
        "shape = \"box\"\nsize = [1.5, 1.5, 0.5]\nopen = [\"-z\"]\nposition = [0, 1, -0.5]\n";
    const Outcome outcome = look(body, {"--technique", "screen_space_photons"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_GT(shareOf("lost"), 0.5);
    EXPECT_TRUE(isLimitReached("view.refraction")) << report().at("limits");
    EXPECT_NE(outcome.out.find("no way out"), std::string::npos) << outcome.out;
}

TEST_F(EyesRays, AreTheSumOfTheirFates) {
    ASSERT_EQ(look("shape = \"sphere\"\nradius = 0.6\nposition = [0, 1, -0.5]\n").exitCode, 0);
    const json rays = report().at("eye_rays");
    EXPECT_EQ(rays.at("pixels"),
              rays.at("came_out").get<int>() + rays.at("lost").get<int>() +
                  rays.at("reflection_limit").get<int>() + rays.at("nesting_limit").get<int>() +
                  rays.at("ended_inside").get<int>() + rays.at("mirror_limit").get<int>());
    EXPECT_GT(shareOf("came_out"), 0.9);
}

}  // namespace
}  // namespace kaustik::test
