// SPDX-License-Identifier: MIT
// Scenes of Tungsten: its conventions by where things come to lie, and every way to be wrong.
#include <glm/gtc/constants.hpp>

#include "tests/unit/importers/foreign_fixture.h"
#include "tests/unit/importers/mesh_file_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kPi = glm::pi<double>();

class Tungsten : public ForeignImport {
  protected:
    Tungsten() : ForeignImport("scene.json") {}

    [[nodiscard]] static std::string primitives(const std::string& list) {
        return "{\n\"primitives\": [\n" + list + "\n]\n}\n";
    }
    // Of a sphere with this bsdf.
    [[nodiscard]] ForeignMaterial material(const std::string& bsdf) const {
        const ForeignScene scene =
            read(primitives("{\"type\": \"sphere\", \"bsdf\": " + bsdf + "}"));
        EXPECT_EQ(scene.materials.size(), 1u);
        return scene.materials.at(0);
    }
};

constexpr const char* kLambert = "\"bsdf\": {\"type\": \"lambert\", \"albedo\": 0.5}";

TEST_F(Tungsten, TheFieldOfViewIsHorizontal) {
    const ForeignScene scene = read(
        R"({"camera": {"type": "pinhole", "fov": 90, "resolution": [200, 100],
            "transform": {"position": [1, 2, 8], "look_at": [1, 2, 3], "up": [0, 1, 0]}}})");
    expectNear(seenAt(scene, {1, 2, -7}), {0, 0});
    expectNear(seenAt(scene, {6, 2, 3}), {1, 0});
    expectNear(seenAt(scene, {1, 4.5, 3}), {0, 1});
    EXPECT_EQ(scene.width, 200u);
}

TEST_F(Tungsten, AQuadLiesInItsXzPlaneAndIsScaledTurnedAndMoved) {
    // About y by a quarter turn, which is clockwise seen from above: x goes to z.
    const ForeignScene scene = read(
        primitives(std::string("{\"type\": \"quad\", ") + kLambert +
                   ", \"transform\": {\"position\": [1, 2, 3], \"scale\": [4, 1, 2], \"rotation\": "
                   "[0, 90, 0]}}"));
    const ForeignShape& quad = scene.shapes.at(0);
    ASSERT_EQ(quad.geometry, ForeignGeometry::plane);
    expectNear(inWorld(quad, {0.5, 0, 0.5}), {0, 2, 5});
    expectNear(inWorld(quad, {-0.5, 0, 0.5}), {0, 2, 1});
    expectNear(inWorld(quad, {0.5, 0, -0.5}), {2, 2, 5});
}

// z first, then x, then y.
TEST_F(Tungsten, RotationsAreAppliedInTheOrderZxy) {
    const ForeignScene scene = read(primitives(std::string("{\"type\": \"cube\", ") + kLambert +
                                               ", \"transform\": {\"rotation\": [90, 90, 90]}}"));
    // x to y by z, y to z by x, z to -x by y.
    expectNear(inWorld(scene.shapes.at(0), {1, 0, 0}), {-1, 0, 0});
    // y to -x by z, which x leaves, and y takes to -z.
    expectNear(inWorld(scene.shapes.at(0), {0, 1, 0}), {0, 0, -1});
}

TEST_F(Tungsten, AMatrixIsWrittenRowByRow) {
    const ForeignScene scene =
        read(primitives(std::string("{\"type\": \"cube\", ") + kLambert +
                        ", \"transform\": [0,0,1,4, 0,2,0,5, 1,0,0,6, 0,0,0,1]}"));
    expectNear(inWorld(scene.shapes.at(0), {1, 1, 1}), {5, 7, 7});
}

TEST_F(Tungsten, LightsHaveTheirPowerInWatts) {
    const ForeignScene scene = read(primitives(
        R"({"type": "point", "power": 100, "transform": {"position": [0, 1, 0]}},
           {"type": "sphere", "name": "lamp", "power": [10, 20, 30], "bsdf": {"type": "null"},
            "transform": {"scale": 0.25}},
           {"type": "quad", "emission": [1, 2, 3], "bsdf": {"type": "null"},
            "transform": {"scale": [2, 1, 0.5]}},
           {"type": "infinite_sphere_cap", "emission": 4, "cap_angle": 30})"));
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_NEAR(scene.lights[0].power.r, 100 / (4 * kPi), 1e-5);
    // Its irradiance is that of a disk of the sky: π L sin².
    EXPECT_NEAR(scene.lights[1].power.r, kPi * 4 * 0.25, 1e-5);
    expectNear(scene.lights[1].direction, {0, -1, 0});
    expectNear(areaLight(scene.shapes.at(0)).powerWatts(), {10, 20, 30});
    expectNear(areaLight(scene.shapes.at(1)).powerWatts(), kPi * glm::dvec3(1, 2, 3));
}

TEST_F(Tungsten, BsdfsAreTheNearestMaterial) {
    EXPECT_EQ(material(R"({"type": "lambert", "albedo": [0.1, 0.2, 0.3]})").material.albedo,
              glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_FLOAT_EQ(material(R"({"type": "dielectric", "ior": 1.33})").material.ior, 1.33f);
    EXPECT_EQ(material(R"({"type": "rough_dielectric"})").material.kind, MaterialKind::dielectric);
    EXPECT_EQ(material(R"({"type": "mirror"})").material.kind, MaterialKind::mirror);
    const Material silver = material(R"({"type": "conductor", "material": "Ag"})").material;
    EXPECT_EQ(silver.kind, MaterialKind::mirror);
    EXPECT_GT(silver.albedo.g, 0.9f);
    const Material plastic = material(R"({"type": "plastic", "ior": 1.5})").material;
    EXPECT_EQ(plastic.kind, MaterialKind::glossy);
    EXPECT_NEAR(plastic.specular.r, 0.04f, 1e-4f);
    const ForeignMaterial checker = material(
        R"({"type": "lambert", "albedo": {"type": "checker", "on_color": 0.8, "off_color": 0.2,
            "res_u": 4, "res_v": 8}})");
    EXPECT_EQ(checker.material.pattern, Pattern::checker);
    EXPECT_EQ(checker.material.uvScale, glm::vec2(4, 8));
    EXPECT_EQ(material(R"({"type": "lambert", "albedo": "wood.png"})").image->file,
              folder / "wood.png");
    EXPECT_FLOAT_EQ(
        material(R"({"type": "transparency", "base": {"type": "lambert", "albedo": 0.25}})")
            .material.albedo.r,
        0.25f);
}

TEST_F(Tungsten, AnEnvironmentsMiddleLiesAlongXThere) {
    const ForeignScene scene =
        read(primitives(R"({"type": "infinite_sphere", "emission": "sky.hdr"})"));
    EXPECT_EQ(scene.environment->file, folder / "sky.hdr");
    // Here it lies along -z, a quarter turn counter-clockwise from x.
    EXPECT_NEAR(scene.environmentTurnDegrees, -90.0, 1e-9);
}

TEST_F(Tungsten, AMediumIsAbsorptionInsideAndFillsTheSceneWhereTheEyeIsInIt) {
    const ForeignScene scene = read(R"({
        "media": [{"name": "fog", "type": "homogeneous", "sigma_a": [1, 2, 3], "sigma_s": 0.5,
                   "density": 2}],
        "camera": {"type": "pinhole", "medium": "fog"},
        "primitives": [{"type": "sphere", "bsdf": {"type": "dielectric"}, "int_medium": "fog"}]})");
    ASSERT_TRUE(scene.medium);
    EXPECT_EQ(scene.medium->absorptionPerMeter, glm::vec3(2, 4, 6));
    EXPECT_EQ(scene.medium->scatteringPerMeter, glm::vec3(1));
    EXPECT_EQ(scene.materials.at(0).material.absorptionPerMeter, glm::vec3(2, 4, 6));
}

TEST_F(Tungsten, MeshesOfItsOwnFormatAreRead) {
    std::string bytes = littleEndian(std::uint64_t{4});
    for (std::size_t i = 0; i < 4; ++i) {
        bytes += littleEndianFloats({kCorners[3 * i], kCorners[3 * i + 1], kCorners[3 * i + 2]}) +
                 littleEndianFloats({0, 0, 0, 0.5f, 0.25f});
    }
    bytes += littleEndian(std::uint64_t{4});
    for (std::size_t i = 0; i < kFaces.size(); ++i) {
        bytes += littleEndian(static_cast<std::uint32_t>(kFaces[i]));
        if (i % 3 == 2) bytes += littleEndian(std::uint32_t{0});
    }
    const std::string text =
        primitives(std::string("{\"type\": \"mesh\", \"file\": \"a.wo3\", ") + kLambert + "}");
    static_cast<void>(folder.file("a.wo3", bytes));
    const ForeignScene scene = read(text);
    EXPECT_EQ(scene.shapes.at(0).mesh.triangles.size(), 4u);
    EXPECT_TRUE(scene.shapes.at(0).mesh.closed);
    EXPECT_EQ(scene.shapes.at(0).mesh.uvs.at(0), glm::vec2(0.5f, 0.25f));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        static_cast<void>(folder.file("a.wo3", bytes.substr(0, size)));
        EXPECT_THAT(ioErrorOf(text), HasSubstr("a.wo3")) << size;
    }
    // An index past the last vertex.
    bytes[bytes.size() - 16] = 4;
    static_cast<void>(folder.file("a.wo3", bytes));
    EXPECT_THAT(ioErrorOf(text), HasSubstr("not there"));
}

TEST_F(Tungsten, WhatHasNoCounterpartIsToldWithItsLine) {
    const std::string notes = notesOf(
        read("{\n\"bsdfs\": [{\"name\": \"unused\", \"type\": \"lambert\"}],\n\"primitives\": [\n"
             "{\"type\": \"curves\", \"name\": \"hair\", \"file\": \"a.fiber\"},\n"
             "{\"type\": \"skydome\"}],\n\"integrator\": {\"type\": \"path_tracer\"}\n}"));
    for (const char* const line :
         {"left out: bsdfs[0] 'unused' (scene.json:2)", "left out: primitive 'hair' (scene.json:4)",
          "primitive 'skydome' (scene.json:5)", "left out: integrator (scene.json:6)"}) {
        EXPECT_THAT(notes, HasSubstr(line));
    }
}

TEST_F(Tungsten, WhatMakesNoSenseIsAnErrorWithItsLine) {
    const auto expectError = [&](const std::string& text, const std::string& part) {
        EXPECT_THAT(errorOf(text), AllOf(HasSubstr("scene.json:"), HasSubstr(part))) << text;
    };
    expectError("[1, 2]", "is an object");
    expectError("3", "is an object");
    expectError("{\"asset\": {}}", "neither 'primitives' nor a 'camera'");
    expectError("{\n\"primitives\": [\n}", ":3: This is not valid JSON");
    expectError("", "not valid JSON");
    expectError("{\"primitives\": 3}", "is a list");
    expectError(primitives("7"), ":3: a primitive is an object");
    expectError(primitives("{\"type\": \"quad\",\n\"bsdf\": \"glas\"}"), ":4: there is no 'glas'");
    expectError(primitives("{\"type\": \"quad\"}"), "a 'bsdf' is needed");
    expectError(primitives(std::string("{\"type\": \"quad\", ") + kLambert +
                           ", \"transform\": {\"scale\": \"x\"}}"),
                "a number is needed");
    expectError(
        primitives(std::string("{\"type\": \"quad\", ") + kLambert + ", \"transform\": [1, 2]}"),
        "16 numbers");
    expectError(
        "{\"bsdfs\": [{\"name\": \"a\", \"type\": \"transparency\", \"base\": \"a\"}], "
        "\"primitives\": [{\"type\": \"quad\", \"bsdf\": \"a\"}]}",
        "without an end");
    expectError("{\"camera\": {\"fov\": 400}}", "between 0 and 180");
    expectError("{\"camera\": {\"transform\": {\"look_at\": [0, 0, 0]}}}", "looks nowhere");
    expectError(std::string(100000, '['), "nested more than");
    EXPECT_THAT(ioErrorOf(primitives(std::string("{\"type\": \"mesh\", \"file\": \"none.obj\", ") +
                                     kLambert + "}")),
                AllOf(HasSubstr("scene.json:3"), HasSubstr("none.obj")));
}

}  // namespace
}  // namespace kaustik::scene::test
