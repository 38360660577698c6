// SPDX-License-Identifier: MIT
// Points that stand for lights which have a size.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/scene/emitters.h"
#include "framework/scene/scene_hash.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene::test {
namespace {

constexpr double kPi = std::numbers::pi;

Scene withFloor() {
    Scene scene;
    scene.materials.push_back({});
    scene.meshes.push_back(makePlane({{10.0, 10.0}, {1, 1}}));
    scene.objects.push_back({"floor", 0, 0, glm::dmat4(1.0)});
    scene.camera.position = {0.0, 5.0, 10.0};
    return scene;
}

Scene withSun(double degrees) {
    Scene scene = withFloor();
    Light sun;
    sun.name = "sun";
    sun.direction = glm::normalize(glm::dvec3(0.3, -1.0, 0.1));
    sun.power = glm::vec3(5.0f);
    sun.angularDiameterRadians = static_cast<float>(degrees * kPi / 180.0);
    scene.lights.push_back(sun);
    findEmitters(scene);
    return scene;
}

Scene withLamp(Mesh mesh) {
    Scene scene = withFloor();
    Material lamp;
    lamp.emission = glm::vec3(3.0f);
    scene.materials.push_back(lamp);
    scene.meshes.push_back(std::move(mesh));
    glm::dmat4 place(1.0);
    place[3] = {0.0, 2.0, 0.0, 1.0};
    scene.objects.push_back({"lamp", 1, 1, place});
    findEmitters(scene);
    return scene;
}

TEST(LightPoints, OfADiscMakeItsIrradianceAndFillIt) {
    Scene scene = withSun(10.0);
    placeLightPoints(scene, 64, 600);
    ASSERT_EQ(scene.lights.size(), 64u);
    const Light& sun = scene.emitters[0].light;
    const double edge = std::tan(5.0 * kPi / 180.0);
    double irradiance = 0.0;
    double squares = 0.0;
    glm::dvec3 middle(0.0);
    for (const Light& point : scene.lights) {
        const double cosine = glm::dot(point.direction, sun.direction);
        irradiance += static_cast<double>(point.power.r) * cosine;
        const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
        EXPECT_LE(tangent, edge * 1.0001);
        squares += tangent * tangent / 64.0;
        middle += point.direction / 64.0;
    }
    EXPECT_NEAR(irradiance, 5.0, 1e-5);
    // Of a disc that is filled evenly the mean square is half of the radius's.
    EXPECT_NEAR(squares, 0.5 * edge * edge, 0.02 * edge * edge);
    EXPECT_LT(glm::length(glm::normalize(middle) - sun.direction), 0.02 * edge);
}

TEST(LightPoints, OfASurfaceHaveItsPower) {
    for (const Mesh& mesh :
         {makePlane({{0.5, 0.4}, {1, 1}}), makeDisc({0.3, 64}), makeSphere({0.2, 32})}) {
        Scene scene = withLamp(mesh);
        placeLightPoints(scene, 32, 600);
        ASSERT_EQ(scene.lights.size(), 32u);
        const EmittingSurface surface(scene, scene.objects[1]);
        double watts = 0.0;
        for (const Light& point : scene.lights) {
            EXPECT_EQ(point.kind, LightKind::surface);
            watts += kPi * static_cast<double>(point.power.r);
        }
        EXPECT_NEAR(watts, 3.0 * kPi * surface.areaSquareMeters(), 1e-5 * watts);
    }
    EXPECT_NEAR(EmittingSurface(withLamp(makeDisc({0.3, 128})), {"", 1, 1, glm::dmat4(1.0)})
                    .areaSquareMeters(),
                kPi * 0.09, 2e-4);
}

// Four times what a quarter lights under its corner: L X/√(1+X²) atan(X/√(1+X²)) for X = Y.
TEST(LightPoints, OfASquareLightWhatIsUnderItAsTheWholeDoes) {
    Scene scene = withLamp(makePlane({{1.0, 1.0}, {1, 1}}));
    scene.objects[1].toWorld[1] = {0.0, -1.0, 0.0, 0.0};
    scene.objects[1].toWorld[2] = {0.0, 0.0, -1.0, 0.0};
    placeLightPoints(scene, 256, 600);
    double found = 0.0;
    for (const Light& point : scene.lights) {
        const glm::dvec3 offset = point.position - glm::dvec3(0.0, 1.0, 0.0);
        const double squared = glm::dot(offset, offset);
        const double cosine = offset.y / std::sqrt(squared);
        found += static_cast<double>(point.power.r) * cosine * cosine / squared;
    }
    const double x = 0.5;
    const double root = std::sqrt(1.0 + x * x);
    const double expected = 3.0 * 4.0 * (x / root * std::atan(x / root));
    EXPECT_NEAR(found, expected, 0.01 * expected);
}

TEST(LightPoints, AreOneWhereASizeCannotBeSeen) {
    EXPECT_EQ(withSun(1e-4).lights.size(), 1u);
    EXPECT_EQ(withSun(0.53).lights.size(), 1u);
    EXPECT_EQ(withSun(2.0).lights.size(), 4u);
    EXPECT_EQ(withSun(10.0).lights.size(), 16u);
    const Scene scene = withSun(1e-4);
    const EmitterPoints points = pointsOf(scene, scene.emitters[0], 0, 600);
    EXPECT_LT(points.blurMeters, points.pixelMeters);
}

TEST(LightPoints, AreNoPartOfTheScenesHash) {
    const auto hashOf = [](const Scene& scene) {
        ContentHash hash;
        addTo(hash, scene);
        return hash.hex();
    };
    Scene scene = withSun(0.53);
    const auto before = hashOf(scene);
    placeLightPoints(scene, 5, 600);
    EXPECT_EQ(scene.lights.size(), 5u);
    EXPECT_EQ(hashOf(scene), before);
    EXPECT_NE(hashOf(withSun(1.0)), before);
    findEmitters(scene);
    EXPECT_EQ(scene.emitters.size(), 1u);
    EXPECT_EQ(hashOf(scene), before);
}

TEST(LightPoints, ShareOutTheirPhotonsWhereAllLightsAreSuch) {
    Scene scene = withSun(10.0);
    EXPECT_EQ(mostLightPoints(scene), 16);
    scene.lights.push_back({});
    EXPECT_EQ(mostLightPoints(scene), 1);
    EXPECT_EQ(mostLightPoints(withFloor()), 1);
}

}  // namespace
}  // namespace kaustik::scene::test
