// SPDX-License-Identifier: MIT
#include "framework/scene/shapes/height_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "tests/unit/scene/shapes/shapes_measures.h"

namespace kaustik::scene {
namespace {

constexpr double kPi = glm::pi<double>();

Wave wave(float amplitude, float wavelength, float direction, float phase, float omega = -1.0f) {
    return {amplitude, wavelength, direction, phase, omega};
}

HeightField severalWaves() {
    return {{2.0f, 1.5f},
            {40, 30},
            {wave(0.03f, 0.8f, 20.0f, 0.5f), wave(0.01f, 0.3f, -70.0f, 2.0f),
             wave(0.02f, 0.5f, 200.0f, 1.0f, 3.0f)}};
}

TEST(HeightField, IsTheSumOfItsCosines) {
    const HeightField field{{1.0f, 1.0f}, {1, 1}, {wave(0.5f, 2.0f, 90.0f, 0.25f, 3.0f)}};
    // Direction 90° is +z: the height does not change with x.
    for (const double x : {-1.0, 0.0, 7.0}) {
        const double expected = 0.5 * std::cos(kPi * 0.6 - 3.0 * 0.2 + 0.25);
        EXPECT_NEAR(evaluateHeightField(field, {x, 0.6}, 0.2).height, expected, 1e-12);
    }
}

TEST(HeightField, NormalsAgreeWithFiniteDifferences) {
    const HeightField field = severalWaves();
    const double step = 1e-5;
    for (const glm::dvec2& xz :
         {glm::dvec2(0.0, 0.0), glm::dvec2(0.31, -0.4), glm::dvec2(-0.9, 0.7)}) {
        for (const double time : {0.0, 0.37, 1e3}) {
            const auto height = [&](double dx, double dz) {
                return evaluateHeightField(field, xz + glm::dvec2(dx, dz), time).height;
            };
            const glm::dvec3 expected = glm::normalize(
                glm::dvec3(-(height(step, 0.0) - height(-step, 0.0)) / (2.0 * step), 1.0,
                           -(height(0.0, step) - height(0.0, -step)) / (2.0 * step)));
            // Central differences: error A k³ step²/6 = 2e-9, cancellation 1e-16/step = 1e-11.
            EXPECT_LT(glm::length(evaluateHeightField(field, xz, time).normal - expected), 1e-8);
        }
    }
}

TEST(HeightField, WavesTravelAlongTheirDirectionAtTheirPhaseSpeed) {
    const HeightField field{{1.0f, 1.0f}, {1, 1}, {wave(0.02f, 0.6f, 30.0f, 0.7f)}};
    // Deep water: a wave of length L moves at sqrt(g L / 2π).
    const double speed = std::sqrt(9.80665 * double(0.6f) / (2.0 * kPi));
    const glm::dvec2 direction(std::cos(kPi / 6.0), std::sin(kPi / 6.0));
    for (const double time : {0.1, 2.5}) {
        const glm::dvec2 start(0.2, -0.1);
        EXPECT_NEAR(evaluateHeightField(field, start + direction * speed * time, time).height,
                    evaluateHeightField(field, start, 0.0).height, 1e-12);
    }
    EXPECT_NEAR(angularFrequency(wave(1.0f, 1.0f, 0.0f, 0.0f)), 7.8496496, 1e-7);
    EXPECT_EQ(angularFrequency(wave(1.0f, 1.0f, 0.0f, 0.0f, 0.0f)), 0.0);
}

TEST(HeightField, CrestFocusesVerticalLightWhereTheoryPutsIt) {
    const double n = 1.333;
    const HeightField field{{1.0f, 1.0f}, {1, 1}, {wave(0.02f, 0.8f, 0.0f, 0.0f, 0.0f)}};
    const double k = 2.0 * kPi / double(0.8f);
    const double expected = n / ((n - 1.0) * double(0.02f) * k * k);
    const double x = 1e-4;
    const HeightSample sample = evaluateHeightField(field, {x, 0.0}, 0.0);
    const glm::dvec3 ray = glm::refract(glm::dvec3(0.0, -1.0, 0.0), sample.normal, 1.0 / n);
    // Beyond the paraxial ray the error is of the order of (k x)² = 6e-7.
    EXPECT_NEAR(x * ray.y / ray.x, expected, expected * 1e-5);
}

TEST(HeightFieldMesh, FollowsTheField) {
    const HeightField field = severalWaves();
    const Mesh mesh = makeHeightField(field, 0.3);
    test::expectSound(mesh);
    EXPECT_FALSE(mesh.closed);
    ASSERT_TRUE(mesh.heightField.has_value());
    ASSERT_EQ(mesh.positions.size(), 41u * 31u);
    EXPECT_EQ(mesh.triangles.size(), 2u * 40u * 30u);
    const glm::vec3 p = mesh.positions[7 * 41 + 3];
    EXPECT_FLOAT_EQ(p.x, (3.0f / 40.0f - 0.5f) * 2.0f);
    EXPECT_FLOAT_EQ(p.z, (7.0f / 30.0f - 0.5f) * 1.5f);
    EXPECT_EQ(mesh.uvs.front(), glm::vec2(0.0f));
    EXPECT_EQ(mesh.uvs.back(), glm::vec2(2.0f, 1.5f));
}

TEST(HeightFieldMesh, SetTimeMovesWaterAndNothingElse) {
    Scene scene;
    scene.meshes.push_back(makeHeightField(severalWaves(), 0.0));
    Mesh other = makeHeightField(severalWaves(), 0.0);
    other.heightField.reset();
    scene.meshes.push_back(other);
    const std::vector<glm::vec3> before = scene.meshes[0].positions;
    setTime(scene, 1.25);
    EXPECT_EQ(scene.timeSeconds, 1.25);
    EXPECT_NE(scene.meshes[0].positions, before);
    EXPECT_EQ(scene.meshes[1].positions, before);
    const Mesh expected = makeHeightField(severalWaves(), 1.25);
    EXPECT_EQ(scene.meshes[0].positions, expected.positions);
    EXPECT_EQ(scene.meshes[0].normals, expected.normals);
    setTime(scene, 0.0);
    EXPECT_EQ(scene.meshes[0].positions, before);
}

// Of so many vertices that several threads have a part each.
TEST(HeightFieldMesh, IsMovedByThreadsAsByOne) {
    HeightField field = severalWaves();
    field.cells = {251, 333};
    Scene scene;
    scene.meshes.push_back(makeHeightField(field, 0.0));
    setTime(scene, 1.25);
    const Mesh expected = makeHeightField(field, 1.25);
    EXPECT_EQ(scene.meshes[0].positions, expected.positions);
    EXPECT_EQ(scene.meshes[0].normals, expected.normals);
}

TEST(HeightFieldMesh, StaysInItsBoundsAtEveryTime) {
    Scene scene;
    scene.meshes.push_back(makeHeightField(severalWaves(), 0.0));
    scene.materials.emplace_back();
    Object object{"water", 0, 0, glm::dmat4(1.0)};
    object.toWorld[3] = glm::dvec4(1e5, 2.0, 3.0, 1.0);
    scene.objects.push_back(object);
    const Bounds bounds = sceneBounds(scene);
    EXPECT_NEAR(bounds.maximum.y - 2.0, 0.06, 1e-7);  // the sum of the amplitudes, as floats
    EXPECT_NEAR(bounds.minimum.x - 1e5, -1.0, 1e-9);
    for (int frame = 0; frame < 50; ++frame) {
        setTime(scene, 0.1 * frame);
        for (const glm::vec3& position : scene.meshes[0].positions) {
            ASSERT_LE(std::abs(double(position.y)), bounds.maximum.y - 2.0 + 1e-9);
        }
    }
}

TEST(HeightFieldMesh, RejectsWhatItCannotBe) {
    EXPECT_THROW((void)makeHeightField({{0.0f, 1.0f}, {4, 4}, {}}, 0.0), ConfigError);
    EXPECT_THROW((void)makeHeightField({{1.0f, 1.0f}, {0, 4}, {}}, 0.0), ConfigError);
    EXPECT_THROW((void)makeHeightField({{1.0f, 1.0f}, {4, 1u << 20}, {}}, 0.0), ConfigError);
    EXPECT_THROW((void)makeHeightField({{1.0f, 1.0f}, {4, 4}, {wave(0.1f, 0.0f, 0.0f, 0.0f)}}, 0.0),
                 ConfigError);
}

}  // namespace
}  // namespace kaustik::scene
