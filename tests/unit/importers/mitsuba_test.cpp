// SPDX-License-Identifier: MIT
// Scenes of Mitsuba: its conventions by where things come to lie, and every way to be wrong.
#include <glm/gtc/constants.hpp>

#include "tests/unit/importers/foreign_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kPi = glm::pi<double>();

class Mitsuba : public ForeignImport {
  protected:
    Mitsuba() : ForeignImport("scene.xml") {}

    [[nodiscard]] static std::string sceneOf(const std::string& contents) {
        return "<scene version=\"3.0.0\">\n" + contents + "\n</scene>\n";
    }
    [[nodiscard]] static std::string sensor(const std::string& properties) {
        return "<sensor type=\"perspective\">" + properties +
               "<film type=\"hdrfilm\"><integer name=\"width\" value=\"200\"/>"
               "<integer name=\"height\" value=\"100\"/></film></sensor>";
    }
    // Of a shape with this BSDF.
    [[nodiscard]] ForeignMaterial material(const std::string& bsdf) const {
        const ForeignScene scene = read(sceneOf("<shape type=\"sphere\">" + bsdf + "</shape>"));
        EXPECT_EQ(scene.materials.size(), 1u);
        return scene.materials.at(0);
    }
    [[nodiscard]] glm::dvec3 albedo(const std::string& color) const {
        return material("<bsdf type=\"diffuse\">" + color + "</bsdf>").material.albedo;
    }
};

TEST_F(Mitsuba, ACameraWithoutATransformLooksAlongZWithXOnItsLeft) {
    const ForeignScene scene = read(sceneOf(sensor("<float name=\"fov\" value=\"90\"/>")));
    expectNear(seenAt(scene, {0, 0, 3}), {0, 0});
    expectNear(seenAt(scene, {3, 0, 3}), {-1, 0});
    expectNear(seenAt(scene, {0, 1.5, 3}), {0, 1});
}

TEST_F(Mitsuba, ACameraLooksFromItsOriginAtItsTarget) {
    const ForeignScene scene = read(
        sceneOf(sensor("<float name=\"fov\" value=\"90\"/><transform name=\"to_world\"><lookat "
                       "origin=\"1, 2, 8\" target=\"1, 2, 3\" up=\"0, 1, 0\"/></transform>")));
    expectNear(seenAt(scene, {1, 2, -7}), {0, 0});
    expectNear(seenAt(scene, {6, 2, 3}), {1, 0});
    expectNear(seenAt(scene, {1, 4.5, 3}), {0, 1});
}

// A point on the edge that the field of view is measured to, in a picture of 200 by 100.
TEST_F(Mitsuba, FieldOfViewIsAlongTheNamedAxis) {
    const auto seen = [&](const char* axis, const glm::dvec3& point) {
        const std::string properties = std::string("<float name=\"fov\" value=\"90\"/>") +
                                       "<string name=\"fovAxis\" value=\"" + axis + "\"/>";
        return seenAt(read(sceneOf(sensor(properties))), point);
    };
    expectNear(seen("x", {-1, 0, 1}), {1, 0});
    expectNear(seen("larger", {-1, 0, 1}), {1, 0});
    expectNear(seen("y", {0, 1, 1}), {0, 1});
    expectNear(seen("smaller", {0, 1, 1}), {0, 1});
    expectNear(seen("diagonal", {-2 / std::sqrt(5.0), 1 / std::sqrt(5.0), 1}), {1, 1});
    // 50 mm where nothing is said: half of the diagonal of 36 by 24 mm at 50.
    const ForeignScene scene = read(sceneOf(sensor("")));
    const double half = 0.5 * std::hypot(36.0, 24.0) / 50.0;
    expectNear(seenAt(scene, {-2 * half / std::sqrt(5.0), half / std::sqrt(5.0), 1}), {1, 1});
}

TEST_F(Mitsuba, TheStepsOfATransformAreAppliedInTheirOrder) {
    const ForeignScene scene = read(
        sceneOf("<shape type=\"rectangle\"><transform name=\"toWorld\"><scale x=\"2\" y=\"3\"/>"
                "<rotate x=\"1\" angle=\"-90\"/><translate y=\"5\"/></transform></shape>"));
    const ForeignShape& shape = scene.shapes.at(0);
    ASSERT_EQ(shape.geometry, ForeignGeometry::plane);
    // From -1 to 1 along x and y there, facing +z; turned, it faces +y.
    expectNear(inWorld(shape, {0.5, 0, 0.5}), {2, 5, 3});
    expectNear(inWorld(shape, {-0.5, 0, -0.5}), {-2, 5, -3});
    expectNear(glm::normalize(inWorld(shape, {0, 1, 0}) - inWorld(shape, {0, 0, 0})), {0, 1, 0});
}

TEST_F(Mitsuba, AMatrixIsWrittenRowByRow) {
    const ForeignScene scene = read(sceneOf(
        "<shape type=\"cube\"><transform name=\"to_world\"><matrix value=\"0 0 1 4  0 2 0 5  "
        "1 0 0 6  0 0 0 1\"/></transform></shape>"));
    expectNear(inWorld(scene.shapes.at(0), {0.5, 0.5, 0.5}), {5, 7, 7});
}

TEST_F(Mitsuba, SpheresAndCylindersStandWhereTheirPropertiesSay) {
    const ForeignScene scene = read(sceneOf(
        "<shape type=\"sphere\"><point name=\"center\" x=\"1\" y=\"2\" z=\"3\"/>"
        "<float name=\"radius\" value=\"0.5\"/></shape>"
        "<shape type=\"cylinder\"><point name=\"p0\" value=\"0, 1, 0\"/>"
        "<point name=\"p1\" value=\"0, 1, 4\"/><float name=\"radius\" value=\"2\"/></shape>"));
    expectNear(inWorld(scene.shapes.at(0), {0, 1, 0}), {1, 2.5, 3});
    expectNear(inWorld(scene.shapes.at(1), {0, -0.5, 0}), {0, 1, 0});
    expectNear(inWorld(scene.shapes.at(1), {0, 0.5, 0}), {0, 1, 4});
    EXPECT_NEAR(glm::length(inWorld(scene.shapes.at(1), {1, 0, 0}) - glm::dvec3(0, 1, 2)), 2.0,
                1e-12);
}

TEST_F(Mitsuba, AnAreaLightHasThePowerOfItsRadianceOverItsArea) {
    const char* const emitter =
        "<emitter type=\"area\"><rgb name=\"radiance\" value=\"3, 6, 9\"/></emitter></shape>";
    const ForeignScene scene = read(
        sceneOf(std::string("<shape type=\"rectangle\"><transform name=\"to_world\"><scale "
                            "x=\"0.5\" y=\"0.25\"/></transform>") +
                emitter + "<shape type=\"sphere\"><float name=\"radius\" value=\"0.5\"/>" +
                emitter + "<shape type=\"disk\">" + emitter + "<shape type=\"cube\">" + emitter));
    // A rectangle of 1 by 0.5, and a ball of radius 0.5: π A L.
    expectNear(areaLight(scene.shapes.at(0)).powerWatts(), kPi * 0.5 * glm::dvec3(3, 6, 9));
    expectNear(areaLight(scene.shapes.at(1)).powerWatts(), kPi * kPi * glm::dvec3(3, 6, 9));
    expectNear(areaLight(scene.shapes.at(2)).powerWatts(), kPi * kPi * glm::dvec3(3, 6, 9));
    // Six sides of 2 by 2.
    EXPECT_NEAR(areaLight(scene.shapes.at(3)).area, 24.0, 1e-6);
}

TEST_F(Mitsuba, LightsWithoutASizeAreAsTheyAre) {
    const ForeignScene scene = read(sceneOf(
        "<emitter type=\"point\" id=\"bulb\"><point name=\"position\" x=\"1\" y=\"2\" z=\"3\"/>"
        "<rgb name=\"intensity\" value=\"4, 5, 6\"/></emitter>"
        "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"-2\" z=\"0\"/>"
        "<spectrum name=\"irradiance\" value=\"7\"/></emitter>"
        "<emitter type=\"spot\"><transform name=\"toWorld\"><lookAt origin=\"0,4,0\" "
        "target=\"0,0,0\" up=\"1,0,0\"/></transform><float name=\"cutoffAngle\" value=\"30\"/>"
        "</emitter>"));
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    expectNear(scene.lights[0].position, {1, 2, 3});
    EXPECT_EQ(scene.lights[0].power, glm::vec3(4, 5, 6));
    expectNear(scene.lights[1].direction, {0, -1, 0});
    EXPECT_EQ(scene.lights[1].power, glm::vec3(7));
    expectNear(scene.lights[2].direction, {0, -1, 0});
    EXPECT_NEAR(scene.lights[2].outerConeRadians, kPi / 6, 1e-6);
    EXPECT_NEAR(scene.lights[2].innerConeRadians, kPi / 8, 1e-6);
}

TEST_F(Mitsuba, GlassHasTheIndexOfItsInsideAgainstItsOutside) {
    EXPECT_NEAR(material("<bsdf type=\"dielectric\"/>").material.ior, 1.5168 / 1.000277, 1e-6);
    EXPECT_NEAR(material("<bsdf type=\"dielectric\"><string name=\"intIOR\" value=\"diamond\"/>"
                         "<float name=\"extIOR\" value=\"1\"/></bsdf>")
                    .material.ior,
                2.417, 1e-6);
    // In water that is a body of the scene the index is against vacuum.
    const ForeignScene scene = read(sceneOf(
        "<shape type=\"cube\"><bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"water\"/>"
        "</bsdf></shape><shape type=\"sphere\"><bsdf type=\"dielectric\"><float name=\"int_ior\" "
        "value=\"1.5\"/><string name=\"ext_ior\" value=\"water\"/></bsdf></shape>"));
    EXPECT_FLOAT_EQ(scene.materials.at(1).material.ior, 1.5f);
    EXPECT_THAT(notesOf(scene), HasSubstr("against vacuum"));
}

// Reflectances at normal incidence in tables of physics, to the percent that they agree to.
TEST_F(Mitsuba, MetalsAreMirrorsByTheirReflectance) {
    const auto metal = [&](const char* properties) {
        return material(std::string("<bsdf type=\"conductor\">") + properties + "</bsdf>").material;
    };
    const Material gold = metal("<string name=\"material\" value=\"Au\"/>");
    EXPECT_EQ(gold.kind, MaterialKind::mirror);
    expectNear(gold.albedo, {0.94, 0.78, 0.39}, 0.02);
    EXPECT_EQ(metal("<string name=\"material\" value=\"none\"/>").albedo, glm::vec3(1.0f));
    // ((n - 1)² + k²) / ((n + 1)² + k²)
    expectNear(metal("<float name=\"eta\" value=\"2\"/><float name=\"k\" value=\"3\"/>").albedo,
               glm::dvec3(10.0 / 18.0), 1e-6);
    const Material rough = material(
                               "<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"0.2\"/>"
                               "</bsdf>")
                               .material;
    EXPECT_EQ(rough.kind, MaterialKind::glossy);
    EXPECT_NEAR(rough.exponent, 48.0, 1e-3);
}

TEST_F(Mitsuba, ColoursBecomeLinearRec709) {
    expectNear(albedo("<rgb name=\"reflectance\" value=\"0.1 0.2 0.3\"/>"), {0.1, 0.2, 0.3}, 1e-6);
    expectNear(albedo("<rgb name=\"reflectance\" value=\"0.4\"/>"), glm::dvec3(0.4), 1e-6);
    // 0.735357 of sRGB is half of the light.
    expectNear(albedo("<srgb name=\"reflectance\" value=\"0.735357\"/>"), glm::dvec3(0.5), 1e-5);
    expectNear(albedo("<srgb name=\"reflectance\" value=\"#ff0000\"/>"), {1, 0, 0}, 1e-6);
    // An even spectrum is grey.
    expectNear(albedo("<spectrum name=\"reflectance\" value=\"400:0.6, 700:0.6\"/>"),
               glm::dvec3(0.6), 1e-6);
    const glm::dvec3 red =
        albedo("<spectrum name=\"reflectance\" value=\"400:0, 590:0, 610:0.5, 700:0.5\"/>");
    EXPECT_GT(red.r, 0.4);
    EXPECT_LT(red.g, 0.1);
    EXPECT_LT(red.b, 0.1);
}

TEST_F(Mitsuba, WhatIsAroundABsdfIsTakenOffAndNoted) {
    const ForeignScene scene = read(sceneOf(
        "<shape type=\"sphere\">\n<bsdf type=\"twosided\"><bsdf type=\"bumpmap\" id=\"bumps\">\n"
        "<texture type=\"bitmap\" name=\"arbitrary\"><string name=\"filename\" value=\"a.png\"/>"
        "</texture>\n<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.3\"/></bsdf>"
        "</bsdf></bsdf></shape>"));
    EXPECT_FLOAT_EQ(scene.materials.at(0).material.albedo.r, 0.3f);
    EXPECT_THAT(notesOf(scene), HasSubstr("left out: texture 'arbitrary' of bsdf 'bumps' "
                                          "(scene.xml:4)"));
}

TEST_F(Mitsuba, ANormalMapIsThatOfTheGlassOrMirrorInIt) {
    const std::string map =
        "<texture type=\"bitmap\" name=\"normalmap\"><boolean name=\"raw\" value=\"true\"/>"
        "<string name=\"filename\" value=\"n.png\"/></texture>";
    const ForeignMaterial mirror =
        material("<bsdf type=\"normalmap\">" + map + "<bsdf type=\"conductor\"/></bsdf>");
    EXPECT_EQ(mirror.material.kind, MaterialKind::mirror);
    ASSERT_TRUE(mirror.normalMap);
    EXPECT_EQ(mirror.normalMap->file, folder / "n.png");
    const ForeignScene diffuse = read(sceneOf("<shape type=\"sphere\"><bsdf type=\"normalmap\">" +
                                              map + "<bsdf type=\"diffuse\"/></bsdf></shape>"));
    EXPECT_FALSE(diffuse.materials.at(0).normalMap);
    EXPECT_THAT(notesOf(diffuse), HasSubstr("only glass and mirrors have normal maps"));
}

TEST_F(Mitsuba, TexturesAreFilesAndCheckers) {
    const ForeignMaterial picture = material(
        "<bsdf type=\"diffuse\"><texture type=\"bitmap\" name=\"reflectance\"><string "
        "name=\"filename\" value=\"a.png\"/><transform name=\"to_uv\"><scale x=\"2\" y=\"3\"/>"
        "</transform></texture></bsdf>");
    ASSERT_TRUE(picture.image);
    EXPECT_EQ(picture.image->file, folder / "a.png");
    EXPECT_EQ(picture.material.uvScale, glm::vec2(2, 3));
    EXPECT_FALSE(picture.turnsTexture);
    const ForeignMaterial turned = material(
        "<bsdf type=\"diffuse\"><texture type=\"bitmap\" name=\"reflectance\"><string "
        "name=\"filename\" value=\"a.png\"/><transform name=\"to_uv\"><scale y=\"-1\"/>"
        "</transform></texture></bsdf>");
    EXPECT_EQ(turned.material.uvScale, glm::vec2(1, 1));
    EXPECT_TRUE(turned.turnsTexture);
    const Material checker = material(
                                 "<bsdf type=\"diffuse\"><texture type=\"checkerboard\" "
                                 "name=\"reflectance\"><rgb name=\"color1\" value=\"0.9\"/>"
                                 "</texture></bsdf>")
                                 .material;
    EXPECT_EQ(checker.pattern, Pattern::checker);
    EXPECT_FLOAT_EQ(checker.albedo.r, 0.4f);
    EXPECT_FLOAT_EQ(checker.patternAlbedo.r, 0.9f);
    // Two squares a repeat there, one here.
    EXPECT_EQ(checker.uvScale, glm::vec2(2));
}

TEST_F(Mitsuba, AMediumIsAbsorptionInsideAndFillsTheSceneWhereTheEyeIsInIt) {
    const ForeignScene scene = read(sceneOf(
        "<medium type=\"homogeneous\" id=\"ink\"><rgb name=\"sigma_t\" value=\"2, 4, 8\"/>"
        "<float name=\"albedo\" value=\"0.25\"/><phase type=\"hg\"><float name=\"g\" "
        "value=\"0.7\"/></phase></medium>" +
        sensor("<ref id=\"ink\"/>") +
        "<shape type=\"sphere\"><bsdf type=\"dielectric\"/><ref name=\"interior\" id=\"ink\"/>"
        "</shape>"));
    ASSERT_TRUE(scene.medium);
    expectNear(scene.medium->scatteringPerMeter, {0.5, 1, 2}, 1e-6);
    expectNear(scene.medium->absorptionPerMeter, {1.5, 3, 6}, 1e-6);
    EXPECT_FLOAT_EQ(scene.medium->anisotropy, 0.7f);
    expectNear(scene.materials.at(0).material.absorptionPerMeter, {1.5, 3, 6}, 1e-6);
    EXPECT_THAT(notesOf(scene), HasSubstr("left out: medium 'ink'"));
}

TEST_F(Mitsuba, AnEnvironmentsMiddleLiesWhereItsMiddleIsThere) {
    static_cast<void>(folder.file("sky.exr", ""));
    const auto turn = [&](const std::string& transform) {
        return read(sceneOf("<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/>"
                            "<transform name=\"to_world\">" +
                            transform + "</transform></emitter>"))
            .environmentTurnDegrees;
    };
    // There it is +z, here -z.
    EXPECT_NEAR(std::abs(turn("")), 180.0, 1e-9);
    EXPECT_NEAR(turn("<rotate y=\"1\" angle=\"180\"/>"), 0.0, 1e-9);
    EXPECT_NEAR(turn("<rotate y=\"1\" angle=\"-90\"/>"), 90.0, 1e-9);
}

TEST_F(Mitsuba, DefaultsIncludesAndForwardReferencesAreFollowed) {
    static_cast<void>(folder.file("parts.xml", sceneOf("<bsdf type=\"diffuse\" id=\"$kind\"/>")));
    const ForeignScene scene =
        read(sceneOf("<default name=\"kind\" value=\"chalk\"/><shape type=\"sphere\" id=\"ball\">"
                     "<ref id=\"late\"/></shape><include filename=\"parts.xml\"/>"
                     "<shape type=\"sphere\"><ref id=\"chalk\"/></shape>"
                     "<bsdf type=\"conductor\" id=\"late\"/>"));
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.shapes[0].name, "ball");
    EXPECT_EQ(scene.materials.at(scene.shapes[0].material).material.name, "late");
    EXPECT_EQ(scene.materials.at(scene.shapes[1].material).material.name, "chalk");
    EXPECT_EQ(notesOf(scene), "");
}

TEST_F(Mitsuba, WhatHasNoCounterpartIsToldWithItsLine) {
    const std::string notes = notesOf(
        read(sceneOf("<integrator type=\"path\"/>\n<shape type=\"hair\" id=\"fur\"/>\n"
                     "<bsdf type=\"diffuse\" id=\"unused\"/>\n<shape type=\"sphere\">\n"
                     "<bsdf type=\"thindielectric\"/>\n</shape>\n<emitter type=\"sunsky\"/>")));
    for (const char* const line :
         {"left out: integrator 'path' (scene.xml:2)", "left out: shape 'fur' (scene.xml:3)",
          "left out: bsdf 'unused' (scene.xml:4)", "left out: shape 'sphere' (scene.xml:5)",
          "left out: emitter 'sunsky' (scene.xml:8)"}) {
        EXPECT_THAT(notes, HasSubstr(line));
    }
}

TEST_F(Mitsuba, WhatMakesNoSenseIsAnErrorWithItsLine) {
    const auto expectError = [&](const std::string& text, const std::string& part) {
        EXPECT_THAT(errorOf(text), AllOf(HasSubstr("scene.xml:"), HasSubstr(part))) << text;
    };
    expectError("<!DOCTYPE scene [<!ENTITY a \"b\">]>\n" + sceneOf(""), ":1: A DOCTYPE");
    expectError(sceneOf("<shape type=\"&lol;\"/>"), ":2: '&lol;'");
    expectError("<scene>\n<shape>\n</scene>", "not valid XML");
    expectError("no XML at all", "XML");
    expectError("", "XML");
    expectError("<mesh/>", "<mesh> and not <scene>");
    expectError(sceneOf("\n<ref id=\"nobody\"/>"), ":3: nothing has the id 'nobody'");
    expectError(sceneOf("<shape type=\"sphere\"><ref id=\"glas\"/></shape><bsdf type=\"null\" "
                        "id=\"glass\"/>"),
                "did you mean 'glass'");
    expectError(sceneOf("<shape type=\"$kind\"/>"), "'$kind' has no <default>");
    expectError(sceneOf("<include filename=\"../other.xml\"/>"), "own folder");
    expectError(sceneOf("<include filename=\"/etc/passwd\"/>"), "own folder");
    expectError(sceneOf("<include filename=\"scene.xml\"/>"), "without an end");
    expectError(sceneOf("<emitter type=\"area\"/>"), "an area light shines from a shape");
    expectError(sceneOf("<shape type=\"sphere\"><float name=\"radius\" value=\"big\"/></shape>"),
                "'big' is not a number");
    expectError(sceneOf("<shape type=\"sphere\"><float name=\"radius\" value=\"nan\"/></shape>"),
                "'nan' is not a number");
    expectError(sceneOf("<shape type=\"sphere\"><bsdf type=\"twosided\" id=\"a\"><ref id=\"a\"/>"
                        "</bsdf></shape>"),
                "without an end");
    expectError(sceneOf("<shape type=\"sphere\"><bsdf type=\"dielectric\"><string name=\"int_ior\" "
                        "value=\"watr\"/></bsdf></shape>"),
                "did you mean 'water'");
    expectError(sceneOf(sensor("<transform name=\"to_world\"><lookat origin=\"0,0,0\" "
                               "target=\"0,1,0\" up=\"0,1,0\"/></transform>")),
                "looks nowhere");
    expectError(sceneOf("<bsdf type=\"null\" id=\"a\"/><bsdf type=\"null\" id=\"a\"/>"), "twice");
    std::string deep;
    for (int i = 0; i < 100000; ++i)
        deep += "<a>";
    expectError(deep, "XML");
    EXPECT_THAT(ioErrorOf(sceneOf("<include filename=\"none.xml\"/>")), HasSubstr("none.xml"));
    EXPECT_THAT(ioErrorOf(sceneOf("<shape type=\"obj\"><string name=\"filename\" "
                                  "value=\"none.obj\"/></shape>")),
                AllOf(HasSubstr("scene.xml:2"), HasSubstr("none.obj")));
}

}  // namespace
}  // namespace kaustik::scene::test
