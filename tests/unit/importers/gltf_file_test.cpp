// SPDX-License-Identifier: MIT
// What a glTF scene becomes: geometry, nodes, camera, lights.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/unit/importers/gltf_file_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::HasSubstr;

TEST_F(GltfImport, ASceneWithOneOfEverythingIsReadWithoutAWarning) {
    const Scene scene = import(tetrahedronScene());
    EXPECT_EQ(warnings(scene), "");
    EXPECT_EQ(scene.name, "scene");
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "glass");
    const Mesh& mesh = scene.meshes.at(scene.objects[0].mesh);
    EXPECT_EQ(mesh.name, "tetra");
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(mesh.origin, glm::dvec3(0.5, 1.0, 1.5));
    EXPECT_TRUE(mesh.closed);
    EXPECT_EQ(scene.materials.at(scene.objects[0].material).name, "crown");
}

TEST_F(GltfImport, TheCameraLooksDownItsOwnNegativeZ) {
    Json document = tetrahedronScene();
    // A quarter turn about +y takes -z to -x.
    document["nodes"][1]["rotation"] = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
    const Camera camera = import(document).camera;
    EXPECT_EQ(camera.position, glm::dvec3(0, 0, 10));
    EXPECT_LT(glm::length(camera.target - glm::dvec3(-1, 0, 10)), 1e-12);
    EXPECT_LT(glm::length(camera.up - glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_NEAR(camera.verticalFovDegrees, 28.6478897565, 1e-9);  // 0.5 rad
    EXPECT_EQ(camera.nearMeters, 0.125);
}

TEST_F(GltfImport, WithoutAPerspectiveCameraOneIsMadeThatSeesTheWholeScene) {
    Json document = tetrahedronScene();
    document["nodes"][1].erase("camera");
    const Scene scene = import(document);
    EXPECT_THAT(warnings(scene), HasSubstr("no perspective camera"));
    const glm::dvec3 forward = glm::normalize(scene.camera.target - scene.camera.position);
    const double halfAngle = 0.5 * scene.camera.verticalFovDegrees * std::acos(-1.0) / 180.0;
    for (const glm::dvec3& corner :
         {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 2, 0), glm::dvec3(0, 0, 3)}) {
        const glm::dvec3 toCorner = corner - scene.camera.position;
        EXPECT_LT(std::acos(glm::dot(glm::normalize(toCorner), forward)), halfAngle);
        EXPECT_GT(glm::dot(toCorner, forward), scene.camera.nearMeters);
    }
}

TEST_F(GltfImport, ADirectionalLightsLuxBecomeWattsPerSquareMetre) {
    const Light light = import(tetrahedronScene()).lights.at(0);
    EXPECT_EQ(light.kind, LightKind::directional);
    EXPECT_EQ(light.power, glm::vec3(1.0f, 0.5f, 0.0f));  // 683 lux at 683 lm/W
    EXPECT_EQ(light.direction, glm::dvec3(0, 0, -1));
}

TEST_F(GltfImport, ASpotLightHasItsConeRangePlaceAndIntensity) {
    Json document = tetrahedronScene();
    document["extensions"]["KHR_lights_punctual"]["lights"][0] = Json::parse(
        R"({"type": "spot", "intensity": 1366, "range": 12.5,
            "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}})");
    // A half turn about x takes -z to +z.
    document["nodes"][2]["rotation"] = {1.0, 0.0, 0.0, 0.0};
    document["nodes"][2]["translation"] = {1.0, 2.0, 3.0};
    const Light light = import(document).lights.at(0);
    EXPECT_EQ(light.kind, LightKind::spot);
    EXPECT_EQ(light.power, glm::vec3(2.0f));
    EXPECT_EQ(light.position, glm::dvec3(1, 2, 3));
    EXPECT_LT(glm::length(light.direction - glm::dvec3(0, 0, 1)), 1e-12);
    EXPECT_EQ(light.innerConeRadians, 0.25f);
    EXPECT_EQ(light.outerConeRadians, 0.5f);
    EXPECT_EQ(light.rangeMeters, 12.5f);
}

TEST_F(GltfImport, APointLightWithoutARangeReachesEverywhere) {
    const Light light =
        import(changed("/extensions/KHR_lights_punctual/lights/0", Json{{"type", "point"}}))
            .lights.at(0);
    EXPECT_EQ(light.kind, LightKind::point);
    EXPECT_EQ(light.rangeMeters, 0.0f);
    EXPECT_FLOAT_EQ(light.power.g, 1.0f / 683.0f);  // the default: 1 candela, white
}

TEST_F(GltfImport, ASceneWithoutALightGetsAWarning) {
    Json document = tetrahedronScene();
    document["nodes"][2].erase("extensions");
    EXPECT_THAT(warnings(import(document)), HasSubstr("no light"));
}

TEST_F(GltfImport, NodeTransformsMultiplyInDoublePrecision) {
    Json document = tetrahedronScene();
    document["scenes"][0]["nodes"] = {1, 2, 3};
    // 1e8 + 0.125: a float there steps by 8.
    document["nodes"][3] = {{"children", {0}}, {"translation", {1e8, 0, 0}}};
    document["nodes"][0]["matrix"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0.125, 0, 0, 1};
    const Object object = import(document).objects.at(0);
    // The matrix is stored by columns: x goes to 2y, y to -2x.
    EXPECT_EQ(glm::dvec3(object.toWorld * glm::dvec4(1, 0, 0, 1)), glm::dvec3(1e8 + 0.125, 2, 0));
    EXPECT_EQ(glm::dvec3(object.toWorld * glm::dvec4(0, 1, 0, 1)), glm::dvec3(1e8 - 1.875, 0, 0));
}

TEST_F(GltfImport, AMeshUsedByTwoNodesIsStoredOnce) {
    Json document = tetrahedronScene();
    document["nodes"][1]["mesh"] = 0;
    const Scene scene = import(document);
    EXPECT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 1u);
}

// Six times the volume of an object in the world; negative when it is inside out.
double worldVolumeTimesSix(const Scene& scene, const Object& object) {
    const Mesh& mesh = scene.meshes.at(object.mesh);
    double sum = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        glm::dvec3 corner[3];
        for (glm::length_t i = 0; i < 3; ++i) {
            corner[i] =
                glm::dvec3(object.toWorld *
                           glm::dvec4(mesh.origin + glm::dvec3(mesh.positions[triangle[i]]), 1.0));
        }
        sum += glm::dot(corner[0], glm::cross(corner[1], corner[2]));
    }
    return sum;
}

TEST_F(GltfImport, AMirroredNodeKeepsItsFacesOutsideOutAndItsPlace) {
    Json document = tetrahedronScene();
    document["nodes"][0]["scale"] = {1.0, -2.0, 1.0};
    document["nodes"][0]["translation"] = {5.0, 0.0, 0.0};
    const Scene scene = import(document);
    const Object& object = scene.objects.at(0);
    EXPECT_GT(glm::determinant(glm::dmat3(object.toWorld)), 0.0);
    // Volume 1 of the tetrahedron, doubled.
    EXPECT_NEAR(worldVolumeTimesSix(scene, object), 12.0, 1e-5);
    const Bounds bounds = sceneBounds(scene);
    EXPECT_LT(glm::length(bounds.minimum - glm::dvec3(5, -4, 0)), 1e-6);
    EXPECT_LT(glm::length(bounds.maximum - glm::dvec3(6, 0, 3)), 1e-6);
    // Normals point outwards: away from the centre of the corners.
    const Mesh& mesh = scene.meshes.at(object.mesh);
    glm::vec3 centre(0.0f);
    for (const glm::vec3& position : mesh.positions)
        centre += 0.25f * position;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_GT(glm::dot(mesh.normals[i], mesh.positions[i] - centre), 0.0f);
    }
}

// Square corners, as a strip would visit them; `indices` and `mode` as given.
Scene importSquare(const kaustik::test::TemporaryFolder& folder, int mode,
                   const std::vector<std::uint16_t>& indices) {
    Json document = tetrahedronScene();
    document["meshes"][0]["primitives"][0]["mode"] = mode;
    document["accessors"][1]["count"] = indices.size();
    document["bufferViews"][1]["byteLength"] = 2 * indices.size();
    document["buffers"][0]["byteLength"] = 48 + 2 * indices.size();
    const std::string binary =
        floatBytes({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) + shortBytes(indices);
    return readGltfFile(folder.file("square.glb", glb(document, binary)));
}

TEST_F(GltfImport, StripsAndFansKeepTheirWinding) {
    const Scene strip = importSquare(folder_, 5, {0, 1, 2, 3});
    const Scene fan = importSquare(folder_, 6, {0, 1, 3, 2});
    for (const Scene* scene : {&strip, &fan}) {
        const Mesh& mesh = scene->meshes.at(0);
        ASSERT_EQ(mesh.triangles.size(), 2u);
        for (const glm::uvec3& triangle : mesh.triangles) {
            const glm::vec3 a = mesh.positions[triangle.x];
            const glm::vec3 normal =
                glm::cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a);
            EXPECT_EQ(normal, glm::vec3(0, 0, 1));
        }
    }
}

TEST_F(GltfImport, PointsAndLinesAreLeftOutWithAWarning) {
    for (const int mode : {0, 1, 2, 3}) {
        const Scene scene = importSquare(folder_, mode, {0, 1, 2, 3});
        EXPECT_TRUE(scene.objects.empty());
        EXPECT_THAT(warnings(scene), HasSubstr("meshes[0].primitives[0] holds points or lines"));
        EXPECT_THAT(warnings(scene), HasSubstr("no triangles"));
    }
}

TEST_F(GltfImport, UvsAreReadAsFloatsAndAsNormalisedIntegers) {
    Json document = tetrahedronScene();
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
    document["accessors"][2] = {{"bufferView", 2},
                                {"componentType", 5121},
                                {"normalized", true},
                                {"count", 4},
                                {"type", "VEC2"}};
    document["bufferViews"][2] = {
        {"buffer", 0}, {"byteOffset", 72}, {"byteLength", 16}, {"byteStride", 4}};
    document["buffers"][0]["byteLength"] = 88;
    const std::string uvs("\x00\xff\x00\x00\x33\x66\x00\x00\x00\x00\x00\x00\xff\xff\x00\x00", 16);
    const Mesh bytes = import(document, tetrahedronBytes() + uvs).meshes.at(0);
    ASSERT_EQ(bytes.uvs.size(), 4u);
    // Vertices are kept in the order in which the triangles meet them: 0, 2, 1, 3.
    // glTF's v runs down the image, the scene's up.
    EXPECT_EQ(bytes.uvs[0], glm::vec2(0.0f, 0.0f));
    EXPECT_FLOAT_EQ(bytes.uvs[2].x, 0.2f);
    EXPECT_FLOAT_EQ(bytes.uvs[2].y, 0.6f);
    EXPECT_EQ(bytes.uvs[3], glm::vec2(1.0f, 0.0f));

    document["accessors"][2] = {
        {"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}};
    document["bufferViews"][2] = {{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 32}};
    document["buffers"][0]["byteLength"] = 104;
    const Mesh floats =
        import(document, tetrahedronBytes() + floatBytes({0, 1, 2, 3, 4, 5, 6, 7})).meshes.at(0);
    EXPECT_EQ(floats.uvs[2], glm::vec2(2.0f, -2.0f));
}

TEST_F(GltfImport, ATextFileWithABufferBesideItOrInItIsRead) {
    Json document = tetrahedronScene();
    document["buffers"][0]["uri"] = "a%20buffer.bin";
    (void)folder_.file("a buffer.bin", tetrahedronBytes());
    EXPECT_EQ(readGltfFile(folder_.file("a.gltf", document.dump())).meshes.at(0).triangles.size(),
              4u);
    // Three vertices, without indices: 36 zero bytes but for 1.0f (0000803f) at x of the second and
    // at y of the third.
    document["buffers"][0] = {{"byteLength", 36},
                              {"uri",
                               "data:application/octet-stream;base64,"
                               "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}};
    document["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
    document["accessors"] = {
        {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}};
    document["meshes"][0]["primitives"][0].erase("indices");
    const Scene scene = readGltfFile(folder_.file("b.gltf", document.dump()));
    EXPECT_EQ(scene.meshes.at(0).origin, glm::dvec3(0.5, 0.5, 0.0));
}

TEST_F(GltfImport, AFileWithoutScenesShowsAllRootNodes) {
    Json document = tetrahedronScene();
    document.erase("scene");
    document.erase("scenes");
    EXPECT_EQ(import(document).objects.size(), 1u);
}

TEST_F(GltfImport, AnEmptySceneIsReadWithWarnings) {
    const Scene scene = import(Json{{"asset", {{"version", "2.0"}}}});
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_THAT(warnings(scene), HasSubstr("no triangles"));
    EXPECT_THAT(warnings(scene), HasSubstr("no light"));
}

}  // namespace
}  // namespace kaustik::scene::test
