// SPDX-License-Identifier: MIT
#include "framework/scene/needs.h"

#include <gtest/gtest.h>

#include "framework/scene/shapes/height_field.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

Material material(MaterialKind kind) {
    Material made;
    made.kind = kind;
    return made;
}

void add(Scene& scene, Mesh mesh, MaterialKind kind) {
    const auto index = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material(kind));
    scene.objects.push_back({"object", index, index, glm::dmat4(1.0)});
}

TEST(SceneNeeds, AnEmptySceneNeedsNothing) {
    const SceneNeeds needs = sceneNeeds({});
    EXPECT_EQ(needs.specularInterfaces, 0);
    EXPECT_EQ(needs.reflectors, 0);
    EXPECT_EQ(needs.refractors, 0);
    EXPECT_EQ(needs.lights, 0);
    EXPECT_FALSE(needs.medium);
    EXPECT_FALSE(needs.animated);
    EXPECT_FALSE(needs.receivers);
    EXPECT_FALSE(needs.glossyReceivers);
    EXPECT_EQ(needs.measuredDepthComplexity, -1);
}

TEST(SceneNeeds, AWaterSurfaceIsOneInterfaceAndABallTwo) {
    Scene scene;
    add(scene, makeHeightField({}, 0.0), MaterialKind::dielectric);
    EXPECT_EQ(sceneNeeds(scene).specularInterfaces, 1);
    add(scene, makeSphere({}), MaterialKind::dielectric);
    EXPECT_EQ(sceneNeeds(scene).specularInterfaces, 3);
    EXPECT_EQ(sceneNeeds(scene).refractors, 2);
}

TEST(SceneNeeds, AllMirrorsTogetherCountOnce) {
    Scene scene;
    add(scene, makePlane({}), MaterialKind::mirror);
    add(scene, makeRing({}), MaterialKind::mirror);
    EXPECT_EQ(sceneNeeds(scene).specularInterfaces, 1);
    EXPECT_EQ(sceneNeeds(scene).reflectors, 2);
    EXPECT_FALSE(sceneNeeds(scene).receivers);
    add(scene, makePlane({}), MaterialKind::lambertian);
    EXPECT_EQ(sceneNeeds(scene).specularInterfaces, 1);
    EXPECT_TRUE(sceneNeeds(scene).receivers);
    EXPECT_FALSE(sceneNeeds(scene).glossyReceivers);
}

TEST(SceneNeeds, AGlossyReceiverIsAReceiverAndNoMirror) {
    Scene scene;
    add(scene, makePlane({}), MaterialKind::glossy);
    EXPECT_TRUE(sceneNeeds(scene).receivers);
    EXPECT_TRUE(sceneNeeds(scene).glossyReceivers);
    EXPECT_EQ(sceneNeeds(scene).specularInterfaces, 0);
    EXPECT_EQ(sceneNeeds(scene).reflectors, 0);
}

TEST(SceneNeeds, OnlyAWaveThatMovesAnimatesTheScene) {
    Scene scene;
    add(scene, makeHeightField({}, 0.0), MaterialKind::dielectric);
    EXPECT_FALSE(sceneNeeds(scene).animated);
    std::vector<Wave>& waves = scene.meshes[0].heightField->waves;
    waves.push_back({0.0f, 0.5f, 0.0f, 0.0f, -1.0f});
    EXPECT_FALSE(sceneNeeds(scene).animated);
    waves.push_back({0.1f, 0.5f, 0.0f, 0.0f, 0.0f});
    EXPECT_FALSE(sceneNeeds(scene).animated);
    waves.push_back({0.1f, 0.5f, 0.0f, 0.0f, -1.0f});
    EXPECT_TRUE(sceneNeeds(scene).animated);
}

TEST(SceneNeeds, AMediumThatDoesNothingIsNone) {
    Scene scene;
    scene.medium.emplace();
    EXPECT_FALSE(sceneNeeds(scene).medium);
    scene.medium->absorptionPerMeter.b = 0.1f;
    EXPECT_TRUE(sceneNeeds(scene).medium);
    scene.medium = Medium{glm::vec3(0.1f), glm::vec3(0.0f), 0.0f};
    EXPECT_TRUE(sceneNeeds(scene).medium);
}

TEST(SceneNeeds, CountsLightsAndIgnoresMeshesWithoutTriangles) {
    Scene scene;
    scene.lights.resize(3);
    add(scene, Mesh{}, MaterialKind::mirror);
    EXPECT_EQ(sceneNeeds(scene).lights, 3);
    EXPECT_EQ(sceneNeeds(scene).reflectors, 0);
}

}  // namespace
}  // namespace kaustik::scene
