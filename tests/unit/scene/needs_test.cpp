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

// What shapes are asked again is what a new look at the scene finds, whatever has changed since:
// the light comes from below, then from a side, and the waves are others.
TEST(SceneNeeds, OfShapesThatAreKeptAreThoseOfTheSceneAsItIs) {
    Scene scene;
    add(scene, makeHeightField({{2.0f, 2.0f}, {16, 16}, {}}, 0.0), MaterialKind::dielectric);
    add(scene, makeSphere({}), MaterialKind::dielectric);
    add(scene, makeHeightField({{4.0f, 4.0f}, {8, 8}, {}}, 0.0), MaterialKind::lambertian);
    scene.objects[1].toWorld[3] = glm::dvec4(0.2, 2.0, 0.0, 1.0);
    scene.objects[2].toWorld[3] = glm::dvec4(0.0, 5.0, 0.0, 1.0);
    scene.lights.emplace_back();
    SceneShapes shapes(scene);
    int seen = 0;
    for (const glm::dvec3 direction : {glm::dvec3(0, -1, 0), {0, 1, 0}, {0.96, -0.28, 0}}) {
        scene.lights[0].direction = direction;
        for (const float amplitude : {0.0f, 0.4f}) {
            const std::vector<Wave> waves = {{amplitude, 0.5f, 30.0f, 0.0f, 1.0f}};
            scene.meshes[0].heightField->waves = waves;
            scene.meshes[2].heightField->waves = waves;
            setTime(scene, scene.timeSeconds + 0.5);
            const SceneNeeds kept = sceneNeeds(shapes);
            const SceneNeeds anew = sceneNeeds(scene);
            EXPECT_EQ(kept.specularInterfaces, anew.specularInterfaces);
            EXPECT_EQ(kept.animated, anew.animated);
            EXPECT_EQ(kept.repeatedHits.transmitted, anew.repeatedHits.transmitted);
            EXPECT_EQ(kept.repeatedHits.reflected, anew.repeatedHits.reflected);
            EXPECT_EQ(kept.repeatedHits.outside, anew.repeatedHits.outside);
            EXPECT_EQ(kept.concaveBody, anew.concaveBody);
            EXPECT_EQ(kept.bodies, anew.bodies);
            EXPECT_EQ(kept.nestedBodies, anew.nestedBodies);
            ASSERT_EQ(kept.reflectedLight.has_value(), anew.reflectedLight.has_value());
            if (!kept.reflectedLight) continue;
            ++seen;
            EXPECT_EQ(kept.reflectedLight->receiver, anew.reflectedLight->receiver);
            EXPECT_EQ(kept.reflectedLight->share, anew.reflectedLight->share);
        }
    }
    EXPECT_GT(seen, 0);
    EXPECT_LT(seen, 6);
}

}  // namespace
}  // namespace kaustik::scene
