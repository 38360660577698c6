// SPDX-License-Identifier: MIT
// Whether light can hit a scene's specular surfaces again.
#include "framework/scene/light_paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/files/scene_file.h"
#include "framework/scene/shapes/height_field.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

void add(Scene& scene, Mesh mesh, MaterialKind kind = MaterialKind::dielectric,
         const glm::dmat4& toWorld = glm::dmat4(1.0)) {
    const auto index = static_cast<std::uint32_t>(scene.meshes.size());
    Material material;
    material.kind = kind;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material);
    scene.objects.push_back({"object", index, index, toWorld});
}

Light sunAt(double degreesFromVertical) {
    Light sun;
    const double angle = glm::radians(degreesFromVertical);
    sun.direction = {std::sin(angle), -std::cos(angle), 0.0};
    return sun;
}

// One wave along x whose steepest slope is `degrees`.
Mesh wavyWater(double degrees) {
    HeightField field;
    Wave wave;
    wave.wavelengthMeters = 0.5f;
    wave.amplitudeMeters =
        static_cast<float>(std::tan(glm::radians(degrees)) * 0.5 / glm::two_pi<double>());
    field.waves.push_back(wave);
    return makeHeightField(field, 0.0);
}

Scene waterUnderSun(double slopeDegrees, double sunDegrees) {
    Scene scene;
    add(scene, wavyWater(slopeDegrees));
    scene.lights.push_back(sunAt(sunDegrees));
    return scene;
}

Mesh withoutATriangle(Mesh mesh) {
    mesh.triangles.pop_back();
    mesh.closed = false;
    return mesh;
}

TEST(RepeatedHits, AreNoneWithoutASpecularSurfaceAndAtASinglePlane) {
    EXPECT_FALSE(repeatedHits({}).reflected);
    for (const MaterialKind kind : {MaterialKind::dielectric, MaterialKind::mirror}) {
        Scene scene;
        add(scene, makePlane({}), kind);
        scene.lights.push_back(sunAt(80.0));
        EXPECT_FALSE(repeatedHits(scene).transmitted);
        EXPECT_FALSE(repeatedHits(scene).reflected);
    }
}

TEST(RepeatedHits, AreNotFromOutsideOfAConvexBodyAlone) {
    for (const MaterialKind kind : {MaterialKind::dielectric, MaterialKind::mirror}) {
        Scene scene;
        add(scene, makeSphere({}), kind);
        EXPECT_TRUE(repeatedHits(scene).transmitted);
        EXPECT_FALSE(repeatedHits(scene).outside);
        Scene two = scene;
        add(two, makeSphere({}), kind, glm::translate(glm::dmat4(1.0), {3.0, 0.0, 0.0}));
        EXPECT_TRUE(repeatedHits(two).outside);
        Scene ring;
        add(ring, makeTorus({}), kind);
        EXPECT_TRUE(repeatedHits(ring).outside);
    }
}

TEST(RepeatedHits, AreThereInABodyEvenIfItsMeshIsOpen) {
    for (const Mesh& ball : {makeSphere({}), withoutATriangle(makeSphere({}))}) {
        Scene scene;
        add(scene, ball);
        scene.lights.push_back(sunAt(0.0));
        EXPECT_TRUE(repeatedHits(scene).transmitted);
    }
}

TEST(RepeatedHits, AreThereBetweenTwoSheets) {
    Scene scene;
    add(scene, makePlane({}));
    add(scene, makePlane({}));
    EXPECT_TRUE(repeatedHits(scene).transmitted);
}

// By hand: what enters goes on within 20 degrees of straight down, which waves of 20 degrees are
// too flat to be hit; what is reflected is turned by 40 degrees, and 70 + 20 is where they are not.
TEST(RepeatedHits, OfReflectedLightBeginWhereWavesAreAsSteepAsItsPath) {
    for (const double sun : {0.0, 29.0}) {
        EXPECT_FALSE(repeatedHits(waterUnderSun(20.0, sun)).transmitted);
        EXPECT_FALSE(repeatedHits(waterUnderSun(20.0, sun)).reflected);
    }
    EXPECT_FALSE(repeatedHits(waterUnderSun(20.0, 31.0)).transmitted);
    EXPECT_TRUE(repeatedHits(waterUnderSun(20.0, 31.0)).reflected);
}

TEST(RepeatedHits, OfRefractedLightBeginWhereTheSunGrazesTheWaves) {
    EXPECT_FALSE(repeatedHits(waterUnderSun(20.0, 69.0)).transmitted);
    EXPECT_TRUE(repeatedHits(waterUnderSun(20.0, 71.0)).transmitted);
    // Steep waves bend light that comes from straight above by as much.
    EXPECT_FALSE(repeatedHits(waterUnderSun(44.0, 0.0)).transmitted);
    EXPECT_TRUE(repeatedHits(waterUnderSun(46.0, 0.0)).transmitted);
}

TEST(RepeatedHits, AreThereForLightFromWithin) {
    EXPECT_TRUE(repeatedHits(waterUnderSun(5.0, 180.0)).transmitted);
    // A lamp over the water's edge sees it at a slant, one far above does not.
    for (const auto& [height, expected] : {std::pair(0.1, true), std::pair(10.0, false)}) {
        Scene scene;
        add(scene, wavyWater(20.0));
        Light lamp;
        lamp.kind = LightKind::point;
        lamp.position = {0.5, height, 0.0};
        scene.lights.push_back(lamp);
        EXPECT_EQ(repeatedHits(scene).transmitted, expected) << height;
    }
}

TEST(RepeatedHits, DependOnHowTheWaterIsPlacedOnly) {
    const glm::dmat4 turned =
        glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(0.0, 0.0, 1.0));
    for (const auto& [sun, expected] : {std::pair(29.0, false), std::pair(31.0, true)}) {
        Scene scene;
        add(scene, wavyWater(20.0), MaterialKind::dielectric, turned);
        scene.lights.push_back(sunAt(sun));
        scene.lights[0].direction = glm::dmat3(turned) * scene.lights[0].direction;
        EXPECT_EQ(repeatedHits(scene).reflected, expected) << sun;
    }
    // Twice as high, so as steep as 36 degrees.
    Scene stretched = waterUnderSun(20.0, 20.0);
    EXPECT_FALSE(repeatedHits(stretched).reflected);
    stretched.objects[0].toWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 2.0, 1.0));
    EXPECT_TRUE(repeatedHits(stretched).reflected);
}

TEST(RepeatedHits, OfShippedWaterAreThoseOfReflectedLightFromALowSun) {
    EXPECT_FALSE(repeatedHits(loadScene("flat-water")).reflected);
    EXPECT_FALSE(repeatedHits(loadScene("pool-reflections")).transmitted);
    EXPECT_TRUE(repeatedHits(loadScene("pool-reflections")).reflected);
}

// A sheet, a wall beyond it where a low sun is reflected to, and the sun.
Scene sheetAndWall(double sunDegrees, const glm::dvec3& wall) {
    Scene scene;
    add(scene, makePlane({{1.0, 1.0}, {1, 1}}));
    scene.materials[0].ior = 1.333f;
    scene.objects[0].name = "sheet";
    add(scene, makeBox({.size = {0.1, 2.0, 4.0}}), MaterialKind::lambertian,
        glm::translate(glm::dmat4(1.0), wall));
    scene.objects[1].name = "wall";
    scene.lights.push_back(sunAt(sunDegrees));
    return scene;
}

TEST(ReflectedLight, IsFresnelsShareWhereAReceiverLiesInItsPath) {
    // At 60 degrees: sin t = sin 60 / 1.333.
    const double inside = std::sqrt(1.0 - 0.75 / (1.333 * 1.333));
    const double s = (0.5 - 1.333 * inside) / (0.5 + 1.333 * inside);
    const double p = (1.333 * 0.5 - inside) / (1.333 * 0.5 + inside);
    const auto seen = reflectedLight(sheetAndWall(60.0, {2.0, 1.0, 0.0}));
    ASSERT_TRUE(seen);
    // The index is a 32-bit float.
    EXPECT_NEAR(seen->share, 0.5 * (s * s + p * p), 1e-7);
    EXPECT_EQ(seen->sheet, "sheet");
    EXPECT_EQ(seen->receiver, "wall");
}

TEST(ReflectedLight, IsNoneWithoutAReceiverInItsPath) {
    EXPECT_FALSE(reflectedLight(sheetAndWall(60.0, {-2.0, 1.0, 0.0})));  // where it comes from
    EXPECT_FALSE(reflectedLight(sheetAndWall(60.0, {2.0, -2.0, 0.0})));  // below
    EXPECT_TRUE(reflectedLight(sheetAndWall(30.0, {1.0, 1.0, 0.0})));    // 2 %
    EXPECT_FALSE(reflectedLight(loadScene("flat-water")));
    EXPECT_TRUE(reflectedLight(loadScene("pool-reflections")));
    // The walls of a room are all around the water, and so is their box.
    EXPECT_TRUE(reflectedLight(loadScene("cornell-bunny")));
}

TEST(ConcaveBody, IsOneWithACornerBeforeOneOfItsFaces) {
    for (const Mesh& mesh :
         {makeSphere({}), makeBox({.size = {1.0, 2.0, 3.0}}),
          makeCylinder({0.3, 1.0, false, false, 64}), withoutATriangle(makeSphere({}))}) {
        Scene scene;
        add(scene, mesh);
        EXPECT_FALSE(concaveBody(scene)) << mesh.name;
    }
    for (const Mesh& mesh : {makeTorus({0.5, 0.1, 32, 32}), makeRing({0.3, 0.7, 0.1, 64})}) {
        Scene scene;
        add(scene, mesh);
        EXPECT_EQ(concaveBody(scene), "object") << mesh.name;
    }
    // Neither a mirror nor a sheet is a body that light is in.
    Scene others;
    add(others, makeTorus({0.5, 0.1, 32, 32}), MaterialKind::mirror);
    add(others, wavyWater(20.0));
    EXPECT_FALSE(concaveBody(others));
    EXPECT_FALSE(concaveBody(loadScene("glass-sphere")));
    EXPECT_TRUE(concaveBody(loadScene("concave-glass")));
}

TEST(Balls, AreTheBodiesThatReflectNothingTotally) {
    const auto sceneOf = [](const Mesh& mesh, const glm::dmat4& toWorld = glm::dmat4(1.0)) {
        Scene scene;
        add(scene, mesh, MaterialKind::dielectric, toWorld);
        return scene;
    };
    EXPECT_TRUE(hasBallsAlone(sceneOf(makeSphere({}))));
    EXPECT_TRUE(hasBallsAlone(loadScene("glass-sphere")));
    EXPECT_FALSE(hasBallsAlone(sceneOf(makeBox({.size = {1.0, 1.0, 1.0}}))));
    EXPECT_FALSE(hasBallsAlone(
        sceneOf(makeSphere({}), glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.9, 1.0)))));
    EXPECT_FALSE(hasBallsAlone(loadScene("glossy-table")));  // there is a ring too
    EXPECT_FALSE(hasBallsAlone(Scene()));
    // Which may lie in one another.
    Scene two = sceneOf(makeSphere({}));
    add(two, makeSphere({}));
    EXPECT_FALSE(hasBallsAlone(two));
}

}  // namespace
}  // namespace kaustik::scene
