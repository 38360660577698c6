// SPDX-License-Identifier: MIT
// The scenes of experiments/scenes: they load, light reaches all that is specular, and they are
// what their head comments say. A tetrahedron stands in for the meshes, which are not committed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/core/error.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/needs.h"
#include "framework/scene/shapes/height_field.h"
#include "tests/unit/importers/mesh_file_fixture.h"
#include "tests/unit/scene/files/scene_file_fixture.h"

namespace kaustik::scene {
namespace {

class ShippedScenes : public test::SceneFile {
  protected:
    ShippedScenes() {
        for (const char* name : {"bunny.obj", "teapot.obj"})
            write(name, test::kTetrahedron);
        for (const char* name : {"dragon_vrip_res2.ply.gz", "dragon_vrip_res3.ply.gz"})
            write(name, test::gzip(test::tetrahedronPly("ascii")));
        write("horse.3ds", test::tetrahedron3ds());
        ::setenv("KAUSTIK_MESHES", folder.c_str(), 1);
    }
    ~ShippedScenes() override { ::unsetenv("KAUSTIK_MESHES"); }

    static const Object& object(const Scene& scene, const std::string& name) {
        return *std::find_if(scene.objects.begin(), scene.objects.end(),
                             [&](const Object& one) { return one.name == name; });
    }
};

// Whether the segment from a to b is cut by the triangle, ends excluded (Möller and Trumbore 1997).
bool cuts(const glm::dvec3& a, const glm::dvec3& b, const std::array<glm::dvec3, 3>& triangle) {
    const glm::dvec3 d = b - a;
    const glm::dvec3 e1 = triangle[1] - triangle[0];
    const glm::dvec3 e2 = triangle[2] - triangle[0];
    const glm::dvec3 p = glm::cross(d, e2);
    const double determinant = glm::dot(e1, p);
    if (std::abs(determinant) < 1e-14) return false;
    const glm::dvec3 s = a - triangle[0];
    const double u = glm::dot(s, p) / determinant;
    const double v = glm::dot(d, glm::cross(s, e1)) / determinant;
    const double t = glm::dot(e2, glm::cross(s, e1)) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-6 && t < 1.0 - 1e-6;
}

std::array<glm::dvec3, 3> worldCorners(const Scene& scene, const Object& object,
                                       const glm::uvec3& triangle) {
    const Mesh& mesh = scene.meshes[object.mesh];
    std::array<glm::dvec3, 3> corners;
    for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 local = mesh.origin + glm::dvec3(mesh.positions[triangle[corner]]);
        corners[static_cast<std::size_t>(corner)] =
            glm::dvec3(object.toWorld * glm::dvec4(local, 1.0));
    }
    return corners;
}

// The share of an object's triangles whose middle sees the light past every receiver.
double litShare(const Scene& scene, const Object& object, const Light& light) {
    const std::vector<glm::uvec3>& triangles = scene.meshes[object.mesh].triangles;
    const std::size_t stride = triangles.size() / 200 + 1;
    int seen = 0;
    int requested = 0;
    for (std::size_t i = 0; i < triangles.size(); i += stride) {
        const auto corners = worldCorners(scene, object, triangles[i]);
        const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        const glm::dvec3 source = light.kind == LightKind::directional
                                      ? middle - 100.0 * light.direction
                                      : light.position;
        bool blocked = false;
        for (const Object& other : scene.objects) {
            if (!isReceiver(scene.materials[other.material].kind)) continue;
            for (const glm::uvec3& triangle : scene.meshes[other.mesh].triangles) {
                blocked = blocked || cuts(source, middle, worldCorners(scene, other, triangle));
            }
        }
        ++requested;
        seen += !blocked;
    }
    return double(seen) / requested;
}

TEST_F(ShippedScenes, AreListedByNameWithADescription) {
    std::set<std::string> names;
    for (const SceneListing& listing : listScenes()) {
        names.insert(listing.name);
        EXPECT_FALSE(listing.description.empty()) << listing.name;
        EXPECT_EQ(loadScene(listing.name).name, listing.name);
        EXPECT_EQ(loadScene(listing.file.string()).name, listing.name);
    }
    for (const char* name :
         {"pool", "flat-water", "glass-sphere", "glossy-table", "cornell-bunny", "ring", "god-rays",
          "glass-bunny", "glass-dragon-low", "glass-dragon", "glass-teapot", "concave-glass",
          "water-from-below", "blocker", "pool-reflections", "tree"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
}

TEST_F(ShippedScenes, HaveALightThatReachesEverySpecularObject) {
    for (const SceneListing& listing : listScenes()) {
        SCOPED_TRACE(listing.name);
        const Scene scene = loadScene(listing.name);
        const SceneNeeds needs = sceneNeeds(scene);
        EXPECT_GE(needs.lights, 1);
        if (listing.name == "tree") continue;  // for its shadow
        EXPECT_GE(needs.specularInterfaces, 1);
        EXPECT_TRUE(needs.receivers);
        for (const Object& object : scene.objects) {
            if (isReceiver(scene.materials[object.material].kind)) continue;
            double best = 0.0;
            for (const Light& light : scene.lights) {
                best = std::max(best, litShare(scene, object, light));
            }
            EXPECT_GT(best, 0.2) << object.name;
        }
    }
}

TEST_F(ShippedScenes, PoolHasTheBunnyOnItsFloorAndWholeUnderWater) {
    const Scene scene = loadScene("pool");
    const Bounds bunny = objectBounds(scene, object(scene, "bunny"));
    const Bounds basin = objectBounds(scene, object(scene, "basin"));
    const Bounds water = objectBounds(scene, object(scene, "water"));
    EXPECT_NEAR(bunny.minimum.y, basin.minimum.y, 1e-6);
    EXPECT_NEAR(bunny.maximum.y - bunny.minimum.y, 0.6, 1e-6);
    EXPECT_LT(bunny.maximum.y, water.minimum.y);
    EXPECT_LT(water.maximum.y, basin.maximum.y);
    EXPECT_LT(water.minimum.x, basin.minimum.x);
    EXPECT_GT(water.maximum.z, basin.maximum.z);
    EXPECT_TRUE(sceneNeeds(scene).animated);
    EXPECT_EQ(sceneNeeds(scene).specularInterfaces, 1);
}

TEST_F(ShippedScenes, FlatWaterIsFlatAndNeedsNoMesh) {
    ::unsetenv("KAUSTIK_MESHES");
    const Scene scene = loadScene("flat-water");
    const Mesh& water = scene.meshes[object(scene, "water").mesh];
    for (const glm::vec3& position : water.positions)
        EXPECT_EQ(position.y, 0.0f);
    EXPECT_FALSE(sceneNeeds(scene).animated);
    EXPECT_EQ(scene.lights.at(0).direction, glm::dvec3(0.0, -1.0, 0.0));
}

TEST_F(ShippedScenes, CornellWaterMeetsItsPaneAtEveryTime) {
    const Scene scene = loadScene("cornell-bunny");
    const HeightField& field = *scene.meshes[object(scene, "water").mesh].heightField;
    const double front = 0.5 * double(field.sizeMeters.y);
    double highest = 0.0;
    for (int step = 0; step < 100; ++step) {
        const double time = 0.07 * step;
        const double x = -1.0 + 0.02 * step;
        // Phases have 8 digits: each pair leaves at most its amplitude times 1e-6.
        EXPECT_LT(std::abs(evaluateHeightField(field, {x, front}, time).height), 1e-7);
        highest = std::max(highest, evaluateHeightField(field, {x, 0.1}, time).height);
    }
    EXPECT_GT(highest, 0.005);
    EXPECT_EQ(sceneNeeds(scene).specularInterfaces, 2);
}

TEST_F(ShippedScenes, GodRaysConvergeOnTheHorsesBack) {
    const Scene scene = loadScene("god-rays");
    EXPECT_TRUE(sceneNeeds(scene).scatteringMedium);
    const Object& surface = object(scene, "water");
    const Bounds horse = objectBounds(scene, object(scene, "horse"));
    const Bounds cave = objectBounds(scene, object(scene, "cave"));
    const Bounds water = objectBounds(scene, surface);
    EXPECT_LT(horse.maximum.y, water.minimum.y);
    EXPECT_GT(horse.minimum.y, cave.minimum.y);
    const glm::dvec3 eye = scene.camera.position;
    EXPECT_TRUE(glm::all(glm::greaterThan(eye, cave.minimum)));
    EXPECT_LT(eye.y, water.minimum.y);
    // The sun through the water, down to where the horse's back is: what one square of 6 cm there
    // gets, over what it would get through still water. The stand-in for the horse is of another
    // height, which is why it is a number here.
    const double height = -2.0;
    const double square = 0.06;
    const HeightField& field = *scene.meshes[surface.mesh].heightField;
    const glm::dvec3 sun = glm::normalize(scene.lights.at(0).direction);
    const glm::dvec3 place(surface.toWorld[3]);
    constexpr int kRays = 600;
    const glm::dvec2 size(field.sizeMeters);
    const glm::dvec2 middle(0.5 * (horse.minimum.x + horse.maximum.x),
                            0.5 * (horse.minimum.z + horse.maximum.z));
    double caught = 0.0;
    for (int i = 0; i < kRays * kRays; ++i) {
        const glm::dvec2 local =
            size * (glm::dvec2(i % kRays + 0.5, i / kRays + 0.5) / double(kRays) - 0.5);
        const HeightSample sample = evaluateHeightField(field, local, 0.0);
        const glm::dvec3 ray = glm::refract(sun, sample.normal, 1.0 / 1.333);
        const glm::dvec3 from = place + glm::dvec3(local.x, sample.height, local.y);
        const glm::dvec3 there = from + ray * ((height - from.y) / ray.y);
        const glm::dvec2 offset = glm::abs(glm::dvec2(there.x, there.z) - middle);
        if (offset.x < 0.5 * square && offset.y < 0.5 * square) caught += 1.0;
    }
    const double concentration = caught / (kRays * kRays) * size.x * size.y / (square * square);
    EXPECT_GT(concentration, 8.0);
}

TEST_F(ShippedScenes, AnUnknownNameIsAnsweredWithTheNearestAndAll) {
    try {
        (void)loadScene("pol");
        FAIL() << "loaded";
    } catch (const ConfigError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("There is no scene 'pol'; did you mean 'pool'?"), std::string::npos)
            << message;
        for (const SceneListing& listing : listScenes()) {
            EXPECT_NE(message.find(listing.name), std::string::npos) << listing.name;
        }
    }
    EXPECT_THROW((void)loadScene(""), ConfigError);
    EXPECT_THROW((void)loadScene("../pool"), ConfigError);
    EXPECT_THROW((void)loadScene("scene.obj"), IoError);
    EXPECT_THROW((void)loadScene((folder / "absent.toml").string()), IoError);
}

}  // namespace
}  // namespace kaustik::scene
